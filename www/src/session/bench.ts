import type { FramedCrop } from "../crop/editor.js";
import type { Hand } from "../lights/hand.js";
import type { KeptQueue, Light } from "../queue/state.js";
import type { Outcome } from "../result.js";
import type { KeptSettings } from "../settings.js";

/** What is on the bench: all that a reload must bring back. */
export interface Bench {
  /** What people call the stack. */
  readonly name: string;
  readonly photographs: number;
  readonly files: readonly File[];
  /** The part of the photographs that is taken. */
  readonly crop: FramedCrop | undefined;
  readonly settings: KeptSettings;
  readonly outcome: Outcome | undefined;
  /** The lights of that result, as people have set them. */
  readonly hand: Hand | undefined;
  /** The finished results of several stacks. */
  readonly queue: KeptQueue | undefined;
}

/** The parts of it that change by themselves. */
export type Part = "stack" | "settings" | "outcome" | "hand" | "queue";

/** How the browser holds a stack. */
export interface KeptStack extends Pick<Bench, "name" | "photographs" | "crop"> {
  /** When its photographs came. */
  readonly time: number;
  /** Names of the parts that hold its files, in their order. */
  readonly files: readonly string[];
}

/** How the browser holds a result. */
export interface KeptOutcome extends Pick<Outcome, "name" | "format" | "size" | "taken"> {
  /** Packed. */
  readonly estimate: unknown;
  /** As those of the stack. */
  readonly files: readonly string[];
  /** As they were estimated. */
  readonly used: readonly string[];
}

/** How the browser holds a queue: the names of its photographs in place of them. */
export interface StoredQueue extends Omit<KeptQueue, "stacks"> {
  readonly stacks: readonly (Omit<KeptQueue["stacks"][number], "result"> & {
    readonly result: (Omit<Light, "files" | "used"> & StoredFiles) | undefined;
  })[];
}

interface StoredFiles {
  readonly files: readonly string[];
  readonly used: readonly string[];
}

/** Most bytes of a result that is kept: what is larger takes as long to write as it took to find. */
export const LARGEST = 400e6;
