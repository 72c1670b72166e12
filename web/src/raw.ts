import { NormalightError } from "./errors.js";
import { encodePng, joined, type Pixels } from "./png.js";
import type { NamedFile, RawImage } from "./types.js";

/** Samples as a file that says of itself how they relate to light: PNG for integers, a float map for floats. */
export function rawFile(image: RawImage, name: string): NamedFile {
  const { width, height, data } = image;
  const channels = image.channels ?? data.length / (width * height);
  const integer = (value: number) => Number.isInteger(value) && value > 0;
  if (!integer(width) || !integer(height) || !integer(channels) || channels > 4) {
    throw wrong(
      name,
      `${data.length} samples are no image of ${width} x ${height} pixels with 1 to 4 channels`,
    );
  }
  const expected = width * height * channels;
  if (data.length !== expected) {
    throw wrong(
      name,
      `${width} x ${height} pixels of ${channels} channels are ${expected} samples, not ${data.length}`,
    );
  }
  const colorSpace =
    image.colorSpace ?? (data instanceof Uint16Array || data instanceof Float32Array ? "linear" : "srgb");
  if (data instanceof Float32Array) {
    if (colorSpace !== "linear")
      throw wrong(name, `samples that are floats must be linear, not ${colorSpace}`);
    return { name: `${name}.pfm`, bytes: floatMap(data, width, height, channels, name) };
  }
  if (!(data instanceof Uint8Array || data instanceof Uint8ClampedArray || data instanceof Uint16Array)) {
    throw wrong(name, "samples must be a Uint8Array, Uint8ClampedArray, Uint16Array or Float32Array");
  }
  const pixels: Pixels = { width, height, channels: channels as Pixels["channels"], data, colorSpace };
  return { name: `${name}.png`, bytes: encodePng(pixels) };
}

/** A portable float map: a text head, then rows from the bottom; a negative scale says that the low byte is first. */
function floatMap(
  data: Float32Array,
  width: number,
  height: number,
  channels: number,
  name: string,
): Uint8Array<ArrayBuffer> {
  if (channels !== 1 && channels !== 3)
    throw wrong(name, `samples that are floats have 1 or 3 channels, not ${channels}`);
  const head = new TextEncoder().encode(`${channels === 3 ? "PF" : "Pf"}\n${width} ${height}\n-1.0\n`);
  const row = width * channels;
  const view = new DataView(new ArrayBuffer(4 * data.length));
  for (let y = 0; y < height; y++) {
    const start = 4 * row * (height - 1 - y);
    for (const [x, value] of data.subarray(y * row, (y + 1) * row).entries()) {
      view.setFloat32(start + 4 * x, value, true);
    }
  }
  return joined([head, new Uint8Array(view.buffer)]);
}

function wrong(name: string, words: string): NormalightError {
  return new NormalightError("input", `${name}: ${words}`);
}
