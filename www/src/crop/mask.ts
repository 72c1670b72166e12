import type { ColorMode } from "normalight";
import type { Engine } from "../engine.js";
import { asPng } from "../large/shrink.js";
import { sideOf, type Taken } from "../large/taken.js";
import { greyPng } from "../mask/png.js";
import { scaled } from "../mask/scaled.js";
import type { Crop } from "./rectangle.js";

/** Photographs that are enough to ask for a mask that is a file. */
const ENOUGH = 3;

/** The part of a mask that belongs to the cropped photographs, at their size. */
export async function croppedMask(
  engine: Engine,
  files: readonly File[],
  mask: File,
  color: ColorMode,
  { crop, times }: Taken & { readonly crop: Crop },
  signal: AbortSignal,
): Promise<File> {
  // What is inside is decided on the whole mask, and at the size of the photographs, as without a crop.
  const { inside, width } = await engine.with((normalight) =>
    normalight.mask(files, { color, mask, ambient: "none", images: ENOUGH, signal }),
  );
  const part = new Uint8Array(crop.width * crop.height);
  for (let row = 0; row < crop.height; row++) {
    const from = (crop.top + row) * width + crop.left;
    part.set(inside.subarray(from, from + crop.width), row * crop.width);
  }
  const [toWidth, toHeight] = [sideOf(crop.width, times), sideOf(crop.height, times)];
  const { width: wide, height: high } = crop;
  const own = { width: wide, height: high, inside: part };
  const png = await greyPng(scaled(own, toWidth, toHeight), toWidth, toHeight);
  return new File([png], asPng(mask.name), { type: "image/png", lastModified: mask.lastModified });
}
