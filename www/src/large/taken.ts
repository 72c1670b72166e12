import type { Crop, Frame } from "../crop/rectangle.js";
import { type Texts, texts } from "../texts/texts.js";

/** How many times smaller the sides of photographs become. */
export type Shrinking = 1 | 2 | 4;

/** Which part of the photographs a run takes, and at which size. */
export interface Taken {
  readonly times: Shrinking;
  /** None for the whole frame. */
  readonly crop: Crop | undefined;
  /** The size of the whole photographs; where they are taken as they are, nobody asks. */
  readonly frame: Frame | undefined;
}

/** Photographs as they are. */
export const AS_THEY_ARE: Taken = { times: 1, crop: undefined, frame: undefined };

/** How photographs were taken, in words; none for as they are. */
export function takenWords({ times, crop, frame }: Taken, { large }: Pick<Texts, "large"> = texts): string {
  return large.taken(crop, times, frame);
}

export { sideOf } from "./side.js";
