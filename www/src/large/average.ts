import { DECODED, encodedBy } from "../relight/encoding.js";

/** Fine enough that no code is off by more than rounding, also where sRGB is steepest. */
const STEPS = 65_536;
const ENCODED = encodedBy(STEPS);

/** Where the pixels of a side go: the first of the new ones that each touches, and its share in that one. */
interface Shares {
  readonly first: Int32Array;
  readonly share: Float32Array;
}

/**
 * A picture with shorter sides, each pixel the mean of the light of those that it stands for. Rows come from the top, some
 * at a time; sums are floats, and become codes only at the end.
 */
export class Average {
  /** RGBA of the new picture. */
  readonly pixels: Uint8ClampedArray<ArrayBuffer>;
  readonly #columns: Shares;
  readonly #rows: Shares;
  /** Red, green, blue and alpha of the new row that is summed, and of the one below it. */
  #sums: Float32Array;
  #next: Float32Array;
  readonly #light: Float32Array;
  /** Rows that have come, and new ones that are done. */
  #come = 0;
  #done = 0;

  /** @param linear whether codes are in proportion to light, or encoded for viewing as by sRGB */
  constructor(
    private readonly width: number,
    height: number,
    private readonly toWidth: number,
    private readonly toHeight: number,
    private readonly linear: boolean,
  ) {
    this.#columns = sharesOf(width, toWidth);
    this.#rows = sharesOf(height, toHeight);
    this.#sums = new Float32Array(4 * toWidth);
    this.#next = new Float32Array(4 * toWidth);
    this.#light = linear ? Float32Array.from({ length: 256 }, (_, code) => code / 255) : DECODED;
    this.pixels = new Uint8ClampedArray(4 * toWidth * toHeight);
  }

  /** Takes the next rows, RGBA. */
  add(rows: Uint8ClampedArray): void {
    const length = 4 * this.width;
    for (let at = 0; at < rows.length; at += length) this.#addRow(rows.subarray(at, at + length));
  }

  #addRow(row: Uint8ClampedArray): void {
    const first = this.#rows.first[this.#come] ?? 0;
    const share = this.#rows.share[this.#come] ?? 0;
    if (first > this.#done) this.#finish();
    this.#addTo(this.#sums, row, share);
    if (share < 1) this.#addTo(this.#next, row, 1 - share);
    this.#come += 1;
    if (this.#come === this.#rows.first.length) this.#finish();
  }

  #addTo(sums: Float32Array, row: Uint8ClampedArray, weight: number): void {
    const { first, share } = this.#columns;
    const light = this.#light;
    for (let x = 0, at = 0; x < this.width; x++, at += 4) {
      // What is transparent has no colour that could count.
      const alpha = (weight * (row[at + 3] ?? 0)) / 255;
      const red = alpha * (light[row[at] ?? 0] ?? 0);
      const green = alpha * (light[row[at + 1] ?? 0] ?? 0);
      const blue = alpha * (light[row[at + 2] ?? 0] ?? 0);
      const own = share[x] ?? 0;
      const to = 4 * (first[x] ?? 0);
      sums[to] = (sums[to] ?? 0) + own * red;
      sums[to + 1] = (sums[to + 1] ?? 0) + own * green;
      sums[to + 2] = (sums[to + 2] ?? 0) + own * blue;
      sums[to + 3] = (sums[to + 3] ?? 0) + own * alpha;
      if (own === 1) continue;
      const rest = 1 - own;
      sums[to + 4] = (sums[to + 4] ?? 0) + rest * red;
      sums[to + 5] = (sums[to + 5] ?? 0) + rest * green;
      sums[to + 6] = (sums[to + 6] ?? 0) + rest * blue;
      sums[to + 7] = (sums[to + 7] ?? 0) + rest * alpha;
    }
  }

  /** Writes the row that is summed; the one below it is the next. */
  #finish(): void {
    const whole = (this.#columns.first.length / this.toWidth) * (this.#rows.first.length / this.toHeight);
    const code = (value: number) =>
      this.linear ? 255 * value : (ENCODED[Math.round(Math.min(value, 1) * STEPS)] ?? 0);
    const sums = this.#sums;
    for (let at = 0, to = 4 * this.#done * this.toWidth; at < sums.length; at += 4, to += 4) {
      const alpha = sums[at + 3] ?? 0;
      if (alpha === 0) continue;
      for (let channel = 0; channel < 3; channel++)
        this.pixels[to + channel] = code((sums[at + channel] ?? 0) / alpha);
      this.pixels[to + 3] = (255 * alpha) / whole;
    }
    this.#done += 1;
    [this.#sums, this.#next] = [this.#next, sums];
    sums.fill(0);
  }
}

/** Pixels of a side meet at most two of the new ones, which are longer. */
function sharesOf(side: number, toSide: number): Shares {
  const step = side / toSide;
  const first = new Int32Array(side);
  const share = new Float32Array(side).fill(1);
  for (let place = 0; place < side; place++) {
    const into = Math.min(Math.floor((place + 1e-9) / step), toSide - 1);
    const over = place + 1 - (into + 1) * step;
    first[place] = into;
    if (over > 1e-9 && into + 1 < toSide) share[place] = 1 - over;
  }
  return { first, share };
}
