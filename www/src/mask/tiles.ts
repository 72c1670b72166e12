/** Side of a tile in pixels: small enough that a stroke copies little, large enough that there are few. */
export const TILE = 256;
/** The same as a shift. */
const BITS = 8;
/** Value of a pixel of the object. */
export const INSIDE = 255;

/** Tiles that are all alike are shared, so that most of a large mask takes no memory. */
const EMPTY = new Uint8Array(TILE * TILE);
const FULL = new Uint8Array(TILE * TILE).fill(INSIDE);

/** Tiles as they were before a change, by their index. */
export type Change = Map<number, Uint8Array>;

/** Whether a tile takes memory of its own. */
export function isOwn(tile: Uint8Array): boolean {
  return tile !== EMPTY && tile !== FULL;
}

/**
 * A mask in square tiles, a byte for each pixel. A tile is never written once its change is complete: whoever changes
 * pixels gets a copy, and the tile before goes to the history, which therefore needs only what was touched.
 */
export class Tiles {
  readonly columns: number;
  readonly rows: number;
  readonly #tiles: Uint8Array[];
  readonly #counts = new WeakMap<Uint8Array, number>();
  #change: Change = new Map();

  constructor(
    readonly width: number,
    readonly height: number,
  ) {
    this.columns = Math.ceil(width / TILE);
    this.rows = Math.ceil(height / TILE);
    this.#tiles = new Array<Uint8Array>(this.columns * this.rows).fill(EMPTY);
  }

  get length(): number {
    return this.#tiles.length;
  }

  tile(index: number): Uint8Array {
    return this.#tiles[index] ?? EMPTY;
  }

  at(x: number, y: number): number {
    if (x < 0 || y < 0 || x >= this.width || y >= this.height) return 0;
    const tile = this.tile((y >> BITS) * this.columns + (x >> BITS));
    return tile[((y & (TILE - 1)) << BITS) | (x & (TILE - 1))] ?? 0;
  }

  /** Sets the pixels of a row from `first` to `last`. */
  span(y: number, first: number, last: number, value: number): void {
    if (y < 0 || y >= this.height) return;
    const [from, to] = [Math.max(first, 0), Math.min(last, this.width - 1)];
    const row = (y & (TILE - 1)) << BITS;
    for (let column = from >> BITS; from <= to && column <= to >> BITS; column++) {
      const index = (y >> BITS) * this.columns + column;
      // Nothing would change in such a tile.
      if (this.tile(index) === (value === 0 ? EMPTY : FULL)) continue;
      const left = column << BITS;
      this.#writable(index).fill(value, row + Math.max(from - left, 0), row + Math.min(to - left + 1, TILE));
    }
  }

  /** Takes one tile out of a whole mask, row after row. */
  takeTile(index: number, whole: Uint8Array): void {
    const [left, top] = this.#corner(index);
    const [width, height] = [Math.min(TILE, this.width - left), Math.min(TILE, this.height - top)];
    const tile = new Uint8Array(TILE * TILE);
    let [inside, same] = [0, true];
    const before = this.tile(index);
    for (let row = 0; row < height; row++) {
      const from = (top + row) * this.width + left;
      for (let column = 0; column < width; column++) {
        const value = whole[from + column] ?? 0;
        const at = (row << BITS) | column;
        tile[at] = value;
        inside += value & 1;
        if (before[at] !== value) same = false;
      }
    }
    if (!same) this.#replace(index, inside === 0 ? EMPTY : inside === TILE * TILE ? FULL : tile);
  }

  /** Sets every pixel; a tile over the frame's edge holds no pixels beyond it. */
  fill(value: number): void {
    for (let index = 0; index < this.length; index++) {
      const [left, top] = this.#corner(index);
      if (value === 0) this.#replace(index, EMPTY);
      else if (left + TILE <= this.width && top + TILE <= this.height) this.#replace(index, FULL);
      else
        for (let row = top; row < Math.min(top + TILE, this.height); row++)
          this.span(row, left, left + TILE - 1, value);
    }
  }

  /** Ends a change: the tiles that it touched, as they were. */
  commit(): Change {
    const change = this.#change;
    this.#change = new Map();
    return change;
  }

  /** Puts tiles back, and gives those that were there. */
  swap(change: Change): Change {
    for (const [index, tile] of change) this.#replace(index, tile);
    return this.commit();
  }

  /** Copies the pixels of one row of tiles into a whole mask. */
  copyRow(row: number, whole: Uint8Array): void {
    for (let column = 0; column < this.columns; column++) {
      const index = row * this.columns + column;
      const tile = this.tile(index);
      const [left, top] = this.#corner(index);
      const width = Math.min(TILE, this.width - left);
      for (let y = top; y < Math.min(top + TILE, this.height); y++) {
        const from = (y - top) << BITS;
        whole.set(tile.subarray(from, from + width), y * this.width + left);
      }
    }
  }

  /** Number of pixels inside; only tiles that have changed are counted. */
  count(): number {
    let sum = 0;
    for (const tile of this.#tiles) {
      let inside = this.#counts.get(tile);
      if (inside === undefined) {
        inside = 0;
        for (const value of tile) inside += value & 1;
        // A tile that is still being written changes its number.
        if (this.#change.size === 0) this.#counts.set(tile, inside);
      }
      sum += inside;
    }
    return sum;
  }

  #corner(index: number): [number, number] {
    return [(index % this.columns) << BITS, Math.floor(index / this.columns) << BITS];
  }

  #replace(index: number, tile: Uint8Array): void {
    const before = this.tile(index);
    if (before === tile) return;
    if (!this.#change.has(index)) this.#change.set(index, before);
    this.#tiles[index] = tile;
  }

  #writable(index: number): Uint8Array {
    if (!this.#change.has(index)) this.#replace(index, this.tile(index).slice());
    const tile = this.tile(index);
    if (isOwn(tile)) return tile;
    const copy = tile.slice();
    this.#tiles[index] = copy;
    return copy;
  }
}
