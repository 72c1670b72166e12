import { type Crop, cropWords, type Frame } from "../crop/rectangle.js";

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
export function takenWords({ times, crop, frame }: Taken): string {
  const part = crop ? [`cropped to ${cropWords(crop)}`] : [];
  const size = times === 1 ? [] : [`at ${times === 2 ? "half" : "a quarter of"} their size`];
  const words = [...part, ...size].join(", ");
  return words && frame ? `${words}, from ${frame.width} × ${frame.height} pixels` : words;
}

/** A side at the size that is taken. */
export function sideOf(pixels: number, times: Shrinking): number {
  return Math.max(Math.round(pixels / times), 1);
}
