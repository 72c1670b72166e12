import { NormalightError } from "./errors.js";
import { rawFile } from "./raw.js";
import type { DrawableSource, ImageSource, LightsSource, RawImage, StackFile } from "./types.js";

/**
 * Files of whatever was handed over. What has no name gets `image_001` and so on, by its place in the list.
 *
 * Pixels are taken when this is called, so canvases and frames may change or be closed afterwards; files are read later.
 *
 * @param sendsFiles whether a worker here understands the browser's files
 */
export function stackFiles(images: Iterable<ImageSource>, sendsFiles: boolean): Promise<StackFile[]> {
  const name = (index: number) => `image_${String(index + 1).padStart(3, "0")}`;
  return Promise.all(Array.from(images, (image, index) => stackFile(image, name(index), sendsFiles)));
}

/** A file of whatever was handed over, with a name for what has none. */
export async function stackFile(image: ImageSource, name: string, sendsFiles: boolean): Promise<StackFile> {
  const bytes = encodedBytes(image);
  if (bytes !== undefined) return { name, bytes };
  if (isInstance(image, "Blob")) return await ofBlob(image, name, sendsFiles);
  if (isRaw(image)) return rawFile(image, name);
  if (isNamed(image)) return image;
  if (isDrawable(image)) {
    // Its pixels are there only when it has loaded.
    if (isInstance(image, "HTMLImageElement") && !image.complete) await image.decode();
    return rawFile(drawn(image, name), name);
  }
  throw new NormalightError("input", `${name}: ${described(image)} is no image and no file`);
}

/** A light file of whatever was handed over. */
export async function lightsFile(lights: LightsSource, sendsFiles: boolean): Promise<StackFile> {
  if (typeof lights === "string") return { name: "lights.txt", bytes: new TextEncoder().encode(lights) };
  if (!Array.isArray(lights)) return await stackFile(lights as ImageSource, "lights.txt", sendsFiles);
  const lines = (lights as readonly (readonly number[])[]).map((light) => `${light.join(" ")}\n`);
  return { name: "lights.txt", bytes: new TextEncoder().encode(lines.join("")) };
}

async function ofBlob(blob: Blob, name: string, sendsFiles: boolean): Promise<StackFile> {
  const named = isInstance(blob, "File") ? blob.name : name;
  if (sendsFiles) return isInstance(blob, "File") ? blob : new File([blob], named);
  return { name: named, bytes: new Uint8Array(await blob.arrayBuffer()) };
}

/** The bytes of an encoded file. */
function encodedBytes(image: ImageSource): Uint8Array<ArrayBuffer> | undefined {
  if (image instanceof ArrayBuffer) return new Uint8Array(image);
  if (!ArrayBuffer.isView(image)) return undefined;
  const bytes = new Uint8Array(image.buffer, image.byteOffset, image.byteLength);
  // A worker gets a copy; memory that is shared cannot be handed over.
  return bytes.buffer instanceof ArrayBuffer ? (bytes as Uint8Array<ArrayBuffer>) : new Uint8Array(bytes);
}

function isRaw(image: unknown): image is RawImage {
  const { data, width, height } = Object(image) as Partial<RawImage>;
  return ArrayBuffer.isView(data) && typeof width === "number" && typeof height === "number";
}

function isNamed(image: unknown): image is StackFile {
  const { name, bytes } = Object(image) as { name?: unknown; bytes?: unknown };
  return typeof name === "string" && bytes instanceof Uint8Array;
}

/** What a canvas can draw. */
function isDrawable(image: unknown): image is DrawableSource {
  return DRAWABLE.some((name) => isInstance(image, name));
}

const DRAWABLE = [
  "HTMLImageElement",
  "HTMLCanvasElement",
  "HTMLVideoElement",
  "OffscreenCanvas",
  "ImageBitmap",
  "VideoFrame",
] as const;

/** The pixels of what a canvas can draw, as sRGB. */
function drawn(image: DrawableSource, name: string): RawImage {
  const sizes = image as unknown as Partial<Record<string, number>>;
  const first = (...keys: string[]) => keys.map((key) => sizes[key]).find((size) => size !== undefined) ?? 0;
  const width = first("naturalWidth", "videoWidth", "displayWidth", "width");
  const height = first("naturalHeight", "videoHeight", "displayHeight", "height");
  if (width === 0 || height === 0)
    throw new NormalightError("input", `${name}: there are no pixels to be taken (yet)`);
  try {
    const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    if (context === null) throw new Error("this browser cannot draw");
    context.drawImage(image, 0, 0, width, height);
    return context.getImageData(0, 0, width, height) as RawImage;
  } catch (error) {
    throw new NormalightError("input", `${name}: its pixels cannot be read: ${error}`);
  }
}

/** Like `instanceof`, where the class may be missing. */
function isInstance<K extends keyof typeof globalThis>(
  value: unknown,
  name: K,
): value is (typeof globalThis)[K] extends { prototype: infer P } ? P : never {
  const type = (globalThis as Record<string, unknown>)[name];
  return typeof type === "function" && value instanceof type;
}

function described(value: unknown): string {
  return Object.prototype.toString.call(value).slice(8, -1);
}
