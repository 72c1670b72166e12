import type { ColorMode, Estimate, Thumbnail } from "normalight";
import type { Engine } from "./engine.js";
import { texts } from "./texts/texts.js";

/** Whole photographs that are kept for showing them again. */
const KEPT = 4;

/** The photographs of a result, decoded again as they were for the estimate. */
export class Photographs {
  readonly #files: readonly (File | undefined)[];
  readonly #color: ColorMode;
  readonly #kept = new Map<number, Promise<Thumbnail>>();

  /** @param files those of the run, photographs or not */
  constructor(
    private readonly engine: Engine,
    private readonly estimate: Estimate,
    files: readonly File[],
  ) {
    // The estimate names them without the folders of an archive, or with them.
    const named = (name: string) =>
      files.find((file) => file.name === name) ?? files.find((file) => file.name.endsWith(`/${name}`));
    this.#files = estimate.lights.map(({ file }) => named(file));
    const { taken } = estimate.plan.color;
    this.#color = taken === "linear" ? "linear" : taken === "sRGB" ? "srgb" : "auto";
  }

  get names(): readonly string[] {
    return this.estimate.lights.map(({ file }) => file);
  }

  /** A photograph in all its pixels. */
  whole(index: number): Promise<Thumbnail> {
    const before = this.#kept.get(index);
    // Set again: the least recently used is the first.
    this.#kept.delete(index);
    const { width, height } = this.estimate;
    const photograph = before ?? this.small(index, Math.max(width, height));
    this.#kept.set(index, photograph);
    photograph.catch(() => this.#kept.delete(index));
    const [oldest] = this.#kept.keys();
    if (this.#kept.size > KEPT && oldest !== undefined) this.#kept.delete(oldest);
    return photograph;
  }

  /** A photograph with so many pixels on its longer side at most. */
  async small(index: number, side: number, signal?: AbortSignal): Promise<Thumbnail> {
    const file = this.#files[index];
    if (!file) throw new Error(texts.photographs.gone);
    const options = { color: this.#color, side, ...(signal ? { signal } : {}) };
    return await this.engine.with((normalight) => normalight.thumbnail(file, options));
  }
}
