import { context, make, paint } from "../dom.js";
import type { Skin } from "../relight/painter.js";
import { FRAGMENT, VERTEX } from "../relight/program.js";
import type { Lamp, Look } from "../relight/shading.js";
import { language } from "../texts/language.js";
import { texts } from "../texts/texts.js";
import { escaped, fill } from "./fill.js";
import style from "./share/page.css?raw";
import template from "./share/page.html?raw";
import script from "./share/page.js?raw";

/** Longer side of the pictures in the file at most, in pixels: it is to be sent by mail. */
const SIDE = 1600;

/** A page of one file that shows the object under a lamp, from the disk and without network. */
export async function sharePage(
  name: string,
  skin: Skin,
  normalColours: Uint8Array<ArrayBuffer>,
  lamps: readonly Lamp[],
  look: Look,
): Promise<string> {
  const scale = Math.min(1, SIDE / Math.max(skin.width, skin.height));
  const [width, height] = [
    Math.max(1, Math.round(scale * skin.width)),
    Math.max(1, Math.round(scale * skin.height)),
  ];
  const { page } = texts.out;
  const data = {
    width,
    height,
    vertex: VERTEX,
    fragment: FRAGMENT,
    lamps,
    look,
    unreadable: page.unreadable,
    // Opaque: colours of half transparent pixels would not stay what they are.
    normals: await pngOf(skin, normalColours, [width, height], "#8080ff"),
    albedo: await pngOf(skin, skin.albedo, [width, height]),
  };
  return fill(template, {
    ...Object.fromEntries(Object.entries(page).map(([key, words]) => [key, escaped(words)])),
    language,
    title: escaped(name === "" ? page.untitled : name),
    style,
    // A script ends at the first such tag, whatever the quotes around it.
    data: JSON.stringify(data).replaceAll("<", "\\u003c"),
    script,
  });
}

/** RGBA pixels in another size, as a PNG in an address. */
async function pngOf(
  { width, height }: Skin,
  rgba: Uint8Array<ArrayBuffer>,
  [wide, high]: readonly [number, number],
  ground?: string,
): Promise<string> {
  const [whole, small] = [make("canvas"), make("canvas")];
  paint(whole, width, height, rgba);
  [small.width, small.height] = [wide, high];
  const drawing = context(small);
  if (ground !== undefined) {
    drawing.fillStyle = ground;
    drawing.fillRect(0, 0, wide, high);
  }
  drawing.imageSmoothingQuality = "high";
  drawing.drawImage(whole, 0, 0, wide, high);
  const blob = await new Promise<Blob | null>((resolve) => small.toBlob(resolve, "image/png"));
  if (!blob) throw new Error(texts.out.noPicture);
  return await addressOf(blob);
}

function addressOf(blob: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
}
