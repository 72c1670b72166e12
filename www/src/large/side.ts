import type { Shrinking } from "./taken.js";

/** A side at the size that is taken. */
export function sideOf(pixels: number, times: Shrinking): number {
  return Math.max(Math.round(pixels / times), 1);
}
