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

/** Pixels of height between two neighbours, beyond what their slopes explain, from which on the surface is torn. */
const TORN = 4;

/** Steepest slope of which neighbours are taken at their word: of steeper ones the normals are guesses. */
const STEEPEST = 12;

/** How often insides are smoothed: steps of a border over so many places are no longer seen, and narrow parts stay. */
const PASSES = 4;

/** Where a surface ends, as a level of the insides: two thirds of a place within its outermost ones. */
export const RIM = 0.7;

/** Evenly spaced places of a relief, and which neighbours the surface joins. */
export class Grid {
  readonly columns: number;
  readonly rows: number;
  /** Whether a place is joined to its right and to its lower neighbour. */
  readonly #right: Uint8Array;
  readonly #down: Uint8Array;

  /** @param step every how many pixels there is a place */
  constructor(
    private readonly relief: Relief,
    private readonly step: number,
  ) {
    this.columns = Math.ceil(relief.width / step);
    this.rows = Math.ceil(relief.height / step);
    const { columns, rows } = this;
    this.#right = new Uint8Array(columns * rows);
    this.#down = new Uint8Array(columns * rows);
    for (let row = 0, at = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++, at++) {
        if (column + 1 < columns) this.#right[at] = this.#joined(at, at + 1, 0) ? 1 : 0;
        if (row + 1 < rows) this.#down[at] = this.#joined(at, at + columns, 1) ? 1 : 0;
      }
    }
  }

  /** The pixel of a place. */
  pixel(at: number): number {
    const { columns, relief, step } = this;
    return Math.floor(at / columns) * step * relief.width + (at % columns) * step;
  }

  /** Whether the surface joins a place and the one to the right of it. */
  right(at: number): boolean {
    return this.#right[at] === 1;
  }

  /** Whether the surface joins a place and the one below it. */
  down(at: number): boolean {
    return this.#down[at] === 1;
  }

  /**
   * Whether two neighbours are both of the object, and no higher above each other than the flatter one's slope explains:
   * round objects get ever steeper towards their rim, but what lies behind a rim is rarely as steep.
   */
  #joined(at: number, other: number, axis: 0 | 1): boolean {
    const { depth, normals } = this.relief;
    const [one, two] = [this.pixel(at), this.pixel(other)];
    const height = Math.abs((depth[one] ?? 0) - (depth[two] ?? 0));
    if (Number.isNaN(height)) return false;
    if (height <= this.step * TORN) return true;
    const slope = (pixel: number) =>
      Math.min(Math.abs((normals[3 * pixel + axis] ?? 0) / (normals[3 * pixel + 2] ?? 0)), STEEPEST);
    return height <= this.step * (TORN + Math.min(slope(one), slope(two)));
  }

  /**
   * How far inside the surface each place lies: from 0 outside to 1. It is the share of short random walks from there that
   * step neither over the border nor over a tear. A border goes along pixels, in steps, and where round objects turn away
   * from the camera each of them is a spike of several pixels; the level lines of this share are smooth.
   */
  insides(): Float32Array {
    const { columns, rows, relief } = this;
    let own = new Float32Array(columns * rows);
    for (let at = 0; at < own.length; at++) own[at] = Number.isNaN(relief.depth[this.pixel(at)] ?? 0) ? 0 : 1;
    let next = own.slice();
    for (let pass = 0; pass < 2 * PASSES; pass++) {
      const [joins, stride, line] =
        pass % 2 === 0 ? [this.#right, 1, columns] : [this.#down, columns, columns * rows];
      for (let at = 0; at < own.length; at++) {
        const here = own[at] ?? 0;
        if (here === 0) continue;
        // Beyond the frame there is no border: the object goes on.
        const place = at % line;
        const before = place < stride ? here : joins[at - stride] ? (own[at - stride] ?? 0) : 0;
        const behind = place + stride >= line ? here : joins[at] ? (own[at + stride] ?? 0) : 0;
        next[at] = (before + 2 * here + behind) / 4;
      }
      [own, next] = [next, own];
    }
    return own;
  }
}
