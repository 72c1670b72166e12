import type { InputFile } from "../wasm/normalight.js";
import type { NamedFile, StackFile } from "./types.js";

/** Bytes that tell formats and signatures apart. */
export const HEAD = 512;

/** Where a PNG's chunks after its header begin: signature (8 bytes) and IHDR (25). */
const AFTER_HEADER = 33;

/** The chunk that says sRGB: length 1, name, rendering intent 0, check sum. */
const SRGB = [0, 0, 0, 1, 0x73, 0x52, 0x47, 0x42, 0, 0xae, 0xce, 0x1c, 0xe9];

/** How PNG files begin. */
const PNG = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];

/** Formats that this browser turned out to decode, or not. */
const decodes = new Map<string, Promise<boolean>>();

/** A format that the module does not read but some browsers do; by content. */
export function browserFormat(head: Uint8Array): string | undefined {
  const text = String.fromCharCode(...head.subarray(0, 32));
  if (text.slice(4, 8) === "ftyp") {
    const brands = text.slice(8);
    if (/^(avif|avis)/.test(brands)) return "AVIF";
    if (/^(heic|heix|hevc|hevx|mif1|msf1)/.test(brands)) return /avif/.test(brands) ? "AVIF" : "HEIC";
  }
  if (text.startsWith("\xff\x0a") || text.startsWith("\0\0\0\x0cJXL ")) return "JPEG XL";
  return undefined;
}

/** The file with its content; a format that only the browser knows becomes a PNG, where the browser does know it. */
export async function read(file: StackFile): Promise<InputFile> {
  const bytes = await bytesOf(file, Number.POSITIVE_INFINITY);
  const format = browserFormat(bytes);
  if (format === undefined) return { name: file.name, bytes };
  try {
    return { name: file.name, bytes: await asPng(bytes), decodedFrom: format };
  } catch {
    // The module says what the file is, and what to do.
    return { name: file.name, bytes };
  }
}

/** What a plan needs: of texts all, of others how they begin, as {@link read} would have it. */
export async function readForPlan(file: StackFile): Promise<NamedFile> {
  if (/\.txt$/i.test(file.name))
    return { name: file.name, bytes: await bytesOf(file, Number.POSITIVE_INFINITY) };
  const bytes = await bytesOf(file, HEAD);
  const format = browserFormat(bytes);
  if (format === undefined) return { name: file.name, bytes };
  let decoded = decodes.get(format);
  if (decoded === undefined) {
    decoded = read(file).then(({ decodedFrom }) => decodedFrom !== undefined);
    decodes.set(format, decoded);
  }
  return { name: file.name, bytes: (await decoded) ? new Uint8Array(PNG) : bytes };
}

/** The first bytes of a file, at most so many. */
export async function bytesOf(file: StackFile, most: number): Promise<Uint8Array<ArrayBuffer>> {
  if (!(file instanceof Blob)) return most < file.bytes.length ? file.bytes.subarray(0, most) : file.bytes;
  try {
    return new Uint8Array(await (most < file.size ? file.slice(0, most) : file).arrayBuffer());
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    throw { kind: "input", message: `${file.name}: cannot be read: ${reason}` };
  }
}

/** A picture as a PNG of 8 bits that says sRGB, its pixels as stored. */
async function asPng(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const bitmap = await createImageBitmap(new Blob([bytes]), { premultiplyAlpha: "none" });
  try {
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d", { colorSpace: "srgb" });
    if (context === null) throw new Error("no canvas");
    context.drawImage(bitmap, 0, 0);
    const png = new Uint8Array(await (await canvas.convertToBlob({ type: "image/png" })).arrayBuffer());
    const said = new Uint8Array(png.length + SRGB.length);
    said.set(png.subarray(0, AFTER_HEADER));
    said.set(SRGB, AFTER_HEADER);
    said.set(png.subarray(AFTER_HEADER), AFTER_HEADER + SRGB.length);
    return said;
  } finally {
    bitmap.close();
  }
}
