import { type Change, isOwn, TILE, type Tiles } from "./tiles.js";

/** Bytes of tiles that are kept for undoing. */
const BUDGET = 96 * 2 ** 20;

/** What was changed, to be undone and done again; the oldest changes are given up when they take too much memory. */
export class History {
  readonly #tiles: Tiles;
  readonly #budget: number;
  #done: Change[] = [];
  #undone: Change[] = [];

  constructor(tiles: Tiles, budget = BUDGET) {
    this.#tiles = tiles;
    this.#budget = budget;
  }

  get canUndo(): boolean {
    return this.#done.length > 0;
  }

  get canRedo(): boolean {
    return this.#undone.length > 0;
  }

  /** Bytes of the tiles that only the history keeps. */
  get bytes(): number {
    return [...this.#done, ...this.#undone].reduce((sum, change) => sum + bytesOf(change), 0);
  }

  /** Ends a change; one that touched nothing is none. */
  commit(): boolean {
    const change = this.#tiles.commit();
    if (change.size === 0) return false;
    this.#done.push(change);
    this.#undone = [];
    // One step back is always possible, whatever it takes.
    while (this.#done.length > 1 && this.bytes > this.#budget) this.#done.shift();
    return true;
  }

  undo(): void {
    const change = this.#done.pop();
    if (change) this.#undone.push(this.#tiles.swap(change));
  }

  redo(): void {
    const change = this.#undone.pop();
    if (change) this.#done.push(this.#tiles.swap(change));
  }

  /** What was done so far cannot be undone: it is the beginning. */
  forget(): void {
    this.#done = [];
    this.#undone = [];
  }

  /** Undoes the last change for good: what follows takes its place. */
  drop(): void {
    this.undo();
    this.#undone.pop();
  }
}

function bytesOf(change: Change): number {
  return [...change.values()].filter(isOwn).length * TILE * TILE;
}
