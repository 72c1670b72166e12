import { decode } from "../relight/encoding.js";

/** A height field as a mesh: x right, y up, z to the camera; the longer side of the frame is 2 long. */
export interface HeightField {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  /** Linear. */
  readonly colours: Float32Array;
  readonly triangles: Uint32Array;
}

/** What a height field is made of, `[height, width]` each. */
export interface Relief {
  readonly width: number;
  readonly height: number;
  /** In pixels; not a number outside the object. */
  readonly depth: Float32Array;
  /** Three numbers a pixel. */
  readonly normals: Float32Array;
  /** 8-bit sRGB with alpha. */
  readonly albedo: Uint8Array;
}

/** Pixels of height between two neighbours beyond which the surface is taken to be torn. */
const TORN = 4;

const NEIGHBOURS = [-1, 0, 1].flatMap((down) => [-1, 0, 1].map((right) => [right, down] as const));

/** Every how many pixels there is a vertex, for so many vertices at most. */
export function stepFor(width: number, height: number, most: number): number {
  return Math.max(1, Math.ceil(Math.sqrt((width * height) / most)));
}

/**
 * Whether a pixel has a neighbour outside the object. There round objects turn away from the camera, and a small error of a
 * normal is a spike.
 */
function atRim({ width, height, depth }: Relief, column: number, row: number): boolean {
  for (const [right, down] of NEIGHBOURS) {
    const [x, y] = [column + right, row + down];
    if (x < 0 || y < 0 || x >= width || y >= height) continue;
    if (Number.isNaN(depth[y * width + x] ?? 0)) return true;
  }
  return false;
}

/** The mesh of a height field, inside the mask and not across its tears. */
export function heightField(relief: Relief, step: number): HeightField {
  const { width, height, depth, normals, albedo } = relief;
  const [columns, rows] = [Math.ceil(width / step), Math.ceil(height / step)];
  const numbers = new Int32Array(columns * rows).fill(-1);
  const made = { positions: [] as number[], normals: [] as number[], colours: [] as number[] };
  const scale = 2 / Math.max(width, height);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const pixel = row * step * width + column * step;
      const z = depth[pixel] ?? Number.NaN;
      if (Number.isNaN(z) || atRim(relief, column * step, row * step)) continue;
      numbers[row * columns + column] = made.positions.length / 3;
      made.positions.push(
        scale * (column * step + 0.5 - width / 2),
        scale * (height / 2 - row * step - 0.5),
        scale * z,
      );
      for (let axis = 0; axis < 3; axis++) {
        made.normals.push(normals[3 * pixel + axis] ?? 0);
        made.colours.push(decode(albedo[4 * pixel + axis] ?? 0));
      }
    }
  }
  const triangles: number[] = [];
  const limit = scale * step * TORN;
  const height_ = (vertex: number) => made.positions[3 * vertex + 2] ?? 0;
  /** Adds a triangle, where it has all its vertices and none is a step away from the others. */
  const add = (a = -1, b = -1, c = -1) => {
    if (a < 0 || b < 0 || c < 0) return;
    const [low, , high] = [height_(a), height_(b), height_(c)].sort((one, other) => one - other);
    if ((high ?? 0) - (low ?? 0) <= limit) triangles.push(a, b, c);
  };
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const at = row * columns + column;
      const [upper, right, lower, across] = [
        numbers[at],
        numbers[at + 1],
        numbers[at + columns],
        numbers[at + columns + 1],
      ];
      // Seen from the camera against the clock.
      add(upper, lower, right);
      add(right, lower, across);
    }
  }
  return {
    positions: Float32Array.from(made.positions),
    normals: Float32Array.from(made.normals),
    colours: Float32Array.from(made.colours),
    triangles: Uint32Array.from(triangles),
  };
}
