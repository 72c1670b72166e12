import type { Quality } from "normalight";

/** What the cost of a run depends on. */
export interface Shape {
  readonly width: number;
  readonly height: number;
  readonly photographs: number;
  /** Samples of a pixel, and bytes of a sample. */
  readonly channels: number;
  readonly bytes: number;
}

const GIB = 2 ** 30;

/** Memory in bytes that a module for browsers can address at most. */
const MODULE = 4 * GIB;

/**
 * Bytes of memory that a run needs, as `normalight batch` expects it (`crates/normalight-batch/src/memory.rs`, measured in
 * `docs/scale.md`); the module used 45 to 80 % of it, for 8 to 12 photographs of 0.07 to 1 megapixels of 8 and 16 bits.
 */
export function memoryOf({ width, height, photographs, channels, bytes }: Shape): number {
  const pixels = width * height;
  return 0.4 * GIB + photographs * pixels * channels * bytes + 120 * pixels;
}

/** Bytes that a page can have here: what the module can address, or less where the computer has less. */
export function memoryHere(): number {
  const { deviceMemory = 4 } = navigator as { deviceMemory?: number };
  return Math.min(MODULE, deviceMemory * GIB);
}

/**
 * Seconds for a megapixel of one photograph with `fast`, where the object fills half of the frame. Measured in the module
 * with two threads: 16 to 20 s for 8 photographs of 0.26 megapixels. Other computers are faster or slower; see {@link Speed}.
 */
const SECONDS = 8;

/** How many times longer a quality takes, as the page says beside it. */
const LONGER: Record<Quality, number> = { fast: 1, default: 2, best: 6 };

/** How fast this computer is: nothing is known of a GPU before it has done a run. */
export class Speed {
  readonly #measured = new Map<string, number>();

  /** A run has taken so long. */
  learn(device: string, shape: Shape, quality: Quality, seconds: number): void {
    this.#measured.set(device, seconds / work(shape, quality));
  }

  /** Seconds that a run will take; nothing where nobody can know. */
  secondsOf(device: string, shape: Shape, quality: Quality): number | undefined {
    const speed = this.#measured.get(device) ?? (device === "cpu" ? SECONDS : undefined);
    return speed === undefined ? undefined : speed * work(shape, quality);
  }

  /** Whether the time is that of this computer. */
  knows(device: string): boolean {
    return this.#measured.has(device);
  }
}

function work({ width, height, photographs }: Shape, quality: Quality): number {
  return ((width * height) / 1e6) * photographs * LONGER[quality];
}
