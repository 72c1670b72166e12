import type { Vector } from "../vector.js";
import { decode } from "./encoding.js";

/** What a photograph is compared with: normals and the brightness of the albedo, of fewer pixels where there are many. */
export interface Matte {
  readonly width: number;
  readonly height: number;
  /** Three numbers a pixel; zero outside the object. */
  readonly normals: Float32Array;
  /** Linear. */
  readonly grey: Float32Array;
}

/** A photograph beside what a matt surface would look like under its light. */
export interface Comparison {
  /** The one number that the matt surface is multiplied by to look like the photograph. */
  readonly brightness: number;
  /** The difference at every pixel, as a share of the photograph's mean brightness; not a number outside the object. */
  readonly residual: Float32Array;
  /** The mean of that. */
  readonly mean: number;
}

/** The linear brightness of 8-bit sRGB with alpha. */
export function greyOf(rgba: Uint8Array): Float32Array {
  const grey = new Float32Array(rgba.length / 4);
  for (let pixel = 0, at = 0; pixel < grey.length; pixel++, at += 4) {
    grey[pixel] = (decode(rgba[at] ?? 0) + decode(rgba[at + 1] ?? 0) + decode(rgba[at + 2] ?? 0)) / 3;
  }
  return grey;
}

/** A surface in another size, by the nearest pixels. */
export function matteOf(
  surface: { width: number; height: number; normals: Float32Array; albedo: Uint8Array },
  width: number,
  height: number,
): Matte {
  const grey = greyOf(surface.albedo);
  if (width === surface.width && height === surface.height) {
    return { width, height, normals: surface.normals, grey };
  }
  const small = {
    width,
    height,
    normals: new Float32Array(3 * width * height),
    grey: new Float32Array(width * height),
  };
  for (let row = 0; row < height; row++) {
    const line = Math.floor(((row + 0.5) / height) * surface.height) * surface.width;
    for (let column = 0; column < width; column++) {
      const from = line + Math.floor(((column + 0.5) / width) * surface.width);
      const to = row * width + column;
      small.normals.set(surface.normals.subarray(3 * from, 3 * from + 3), 3 * to);
      small.grey[to] = grey[from] ?? 0;
    }
  }
  return small;
}

/** How bright a matt surface is under a light, at every pixel; not a number outside the object. */
export function matteUnder({ normals, grey }: Matte, [x, y, z]: Vector): Float32Array {
  return grey.map((own, pixel) => {
    const [a = 0, b = 0, c = 0] = [normals[3 * pixel], normals[3 * pixel + 1], normals[3 * pixel + 2]];
    return a === 0 && b === 0 && c === 0 ? Number.NaN : own * Math.max(a * x + b * y + c * z, 0);
  });
}

/** Fits one brightness to a photograph by least squares, and tells what is left. */
export function compare(expected: Float32Array, seen: Float32Array): Comparison {
  let [products, squares, whole, count] = [0, 0, 0, 0];
  for (const [pixel, value] of expected.entries()) {
    if (Number.isNaN(value)) continue;
    const found = seen[pixel] ?? 0;
    products += value * found;
    squares += value * value;
    whole += found;
    count += 1;
  }
  const brightness = squares > 0 ? products / squares : 0;
  const scale = whole > 0 ? count / whole : 0;
  let sum = 0;
  const residual = expected.map((value, pixel) => {
    if (Number.isNaN(value)) return value;
    const left = scale * Math.abs((seen[pixel] ?? 0) - brightness * value);
    sum += left;
    return left;
  });
  return { brightness, residual, mean: count > 0 ? sum / count : 0 };
}

/** The mean of several maps, pixel by pixel. */
export class Mean {
  #sum: Float32Array | undefined;
  #count = 0;

  add(map: Float32Array): void {
    this.#count += 1;
    if (this.#sum === undefined) this.#sum = map.slice();
    else for (const [pixel, value] of map.entries()) this.#sum[pixel] = (this.#sum[pixel] ?? 0) + value;
  }

  get map(): Float32Array {
    const { length } = this.#sum ?? [];
    return (this.#sum ?? new Float32Array(length)).map((value) => value / Math.max(this.#count, 1));
  }
}
