import { History } from "./history.js";
import type { Operation } from "./protocol.js";
import { type Box, type Place, polygon, stroke } from "./shapes.js";
import { Tiles } from "./tiles.js";
import type { MaskWork } from "./work.js";

/** Milliseconds of work after which the page gets its turn. */
const SLICE = 12;

/** The mask that is being edited: its pixels, what was done to it, and what can be done. */
export class MaskDocument {
  readonly tiles: Tiles;
  readonly history: History;
  readonly #work: MaskWork;
  readonly #changed: (box?: Box) => void;
  /** Heavy operations are done one after the other. */
  #busy: Promise<unknown> = Promise.resolve();
  #previewing = false;

  /** @param changed hears what must be drawn again: a part of the frame, or all of it */
  constructor(width: number, height: number, work: MaskWork, changed: (box?: Box) => void) {
    this.tiles = new Tiles(width, height);
    this.history = new History(this.tiles);
    this.#work = work;
    this.#changed = changed;
  }

  /** A part of a stroke; {@link MaskDocument.commit} ends it. */
  stroke(from: Place, to: Place, radius: number, value: number): void {
    this.#changed(stroke(this.tiles, from, to, radius, value));
  }

  commit(): void {
    this.#previewing = false;
    this.history.commit();
    this.#changed();
  }

  polygon(places: readonly Place[], value: number): void {
    polygon(this.tiles, places, value);
    this.commit();
  }

  fill(value: number): void {
    this.tiles.fill(value);
    this.commit();
  }

  undo(): void {
    this.#previewing = false;
    this.history.undo();
    this.#changed();
  }

  redo(): void {
    this.#previewing = false;
    this.history.redo();
    this.#changed();
  }

  /** All of it must be drawn again. */
  repaint(): void {
    this.#changed();
  }

  /** Something that needs the whole mask; done in the worker. */
  operate(operation: Operation): Promise<void> {
    return this.#queued(async () => {
      const { width, height } = this.tiles;
      const mask = await this.whole();
      await this.#take(await this.#work.do("operate", { mask, width, height, operation }, [mask.buffer]));
      this.#previewing = operation.kind === "threshold";
    }, operation.kind === "threshold");
  }

  /** Takes another mask in place of this one; one step back is this one. */
  take(mask: Uint8Array): Promise<void> {
    return this.#queued(() => this.#take(mask), false);
  }

  /** The mask in one piece. */
  async whole(): Promise<Uint8Array<ArrayBuffer>> {
    const { width, height, rows } = this.tiles;
    const mask = new Uint8Array(width * height);
    await sliced(rows, (row) => this.tiles.copyRow(row, mask));
    return mask;
  }

  #queued(work: () => Promise<void>, preview: boolean): Promise<void> {
    const turn = this.#busy.then(async () => {
      // A slider that moves on replaces what it did, and leaves one step to undo.
      if (preview && this.#previewing) this.history.drop();
      this.#previewing = false;
      await work();
    });
    this.#busy = turn.catch(() => undefined);
    return turn;
  }

  async #take(mask: Uint8Array): Promise<void> {
    await sliced(this.tiles.length, (index) => this.tiles.takeTile(index, mask));
    this.history.commit();
    this.#changed();
  }
}

/** Does something for each number, and lets the page go on in between. */
async function sliced(count: number, work: (index: number) => void): Promise<void> {
  let began = performance.now();
  for (let index = 0; index < count; index++) {
    work(index);
    if (performance.now() - began < SLICE) continue;
    await new Promise((resolve) => setTimeout(resolve));
    began = performance.now();
  }
}
