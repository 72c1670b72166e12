import type { Estimate, Thumbnail } from "normalight";
import type { Photographs } from "../photographs.js";
import { type Comparison, compare, greyOf, type Matte, Mean, matteOf, matteUnder } from "./residual.js";

/** Longer side of the pictures that are compared, in pixels: enough to see where, and quick with many photographs. */
const SIDE = 1024;

/** A map and its size. */
export interface GreyMap {
  readonly width: number;
  readonly height: number;
  readonly values: Float32Array;
}

/** Compares the photographs of a result with the matt surface that it describes. */
export class Distrust {
  readonly #side: number;
  #matte: Matte | undefined;
  #mean: Promise<GreyMap> | undefined;
  readonly #closed = new AbortController();

  constructor(
    private readonly estimate: Estimate,
    private readonly photographs: Photographs,
  ) {
    this.#side = Math.min(SIDE, Math.max(estimate.width, estimate.height));
  }

  /** What one photograph leaves. */
  async of(index: number): Promise<GreyMap & Comparison> {
    const photograph = await this.photographs.small(index, this.#side, this.#closed.signal);
    const { width, height } = photograph;
    const comparison = this.#compare(index, photograph);
    return { ...comparison, width, height, values: comparison.residual };
  }

  /** What all photographs leave, in the mean. @param told hears of every one that is done */
  mean(told: (done: number, of: number) => void): Promise<GreyMap> {
    this.#mean ??= this.#measure(told).catch((error: unknown) => {
      this.#mean = undefined;
      throw error;
    });
    return this.#mean;
  }

  /** Stops what is under way. */
  close(): void {
    this.#closed.abort();
  }

  async #measure(told: (done: number, of: number) => void): Promise<GreyMap> {
    const { length } = this.photographs.names;
    const mean = new Mean();
    let size = { width: 1, height: 1 };
    for (let index = 0; index < length; index++) {
      const { width, height, values } = await this.of(index);
      size = { width, height };
      mean.add(values);
      told(index + 1, length);
    }
    return { ...size, values: mean.map };
  }

  #compare(index: number, { width, height, rgba }: Thumbnail): Comparison {
    if (this.#matte?.width !== width || this.#matte.height !== height) {
      const { normalMap, albedo } = this.estimate;
      const whole = { width: this.estimate.width, height: this.estimate.height };
      this.#matte = matteOf({ ...whole, normals: normalMap.data, albedo }, width, height);
    }
    const { x, y, z } = this.estimate.lights[index] ?? { x: 0, y: 0, z: 1 };
    return compare(matteUnder(this.#matte, [x, y, z]), greyOf(rgba));
  }
}
