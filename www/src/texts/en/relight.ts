import { fixed, percent } from "../numbers.js";

/** The object under lamps of one's own, and the photographs replayed beside it. */
export const relight = {
  lamp: (number: number, direction: string) => `Lamp ${number}: ${direction}`,
  chosen: (number: number, of: number) => `Lamp ${number} of ${of}`,
  percent: (share: number) => `${percent(share)} %`,
  times: (factor: number) => `${fixed(factor, 1)} ×`,
  byProcessor:
    "This browser has no WebGL2 for a picture of this size: the processor paints, coarser while a lamp moves.",
  play: "Play",
  stop: "Stop",
  noPhotograph: "none: lamps of your own",
  difference: (share: number) =>
    `A matt surface differs from this photograph by ${fixed(100 * share, 1)}\u00a0% of its brightness.`,
  failed: (why: string) => `This photograph cannot be shown: ${why}`,
};
