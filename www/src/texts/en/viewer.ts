import type { Spread } from "../../viewer/histogram.js";
import { fixed, short } from "../numbers.js";

/** The picture of all maps, what is read of it, and the histogram. */
export const viewer = {
  nothing: "nothing",
  fetching: (map: string) => `Fetching ${map}`,
  failed: (map: string, why: string) => `${map} cannot be shown: ${why}`,
  fullScreen: "Full screen",
  leaveFullScreen: "Leave full screen",
  /** What the picture shows, for screen readers. */
  shown: (map: string, other: string | undefined) =>
    other === undefined ? `${map}.` : `${map} and ${other}, side by side.`,
  divider: (left: string, right: string) => `Divider between ${left} and ${right}`,
  dividerAt: (percent: number) => `${percent} % of the width`,
  scale: (percent: number) => `${percent} %`,
  histogram: (map: string) => `Histogram of ${map}`,
  spread: (channel: string, { count, mean, lowest, highest }: Spread) =>
    count === 0
      ? `${channel}: no pixels`
      : `${channel} ${short(lowest)} to ${short(highest)}, mean ${short(mean)}`,
  values: "values",
  point: "Point at the picture to read its values.",
  outside: "outside the object",
  pixel: "pixel",
  normal: "normal",
  tilt: "tilt",
  degrees: (degrees: number) => `${fixed(degrees, 1)}°`,
  albedo: "albedo",
  depth: "depth",
  pixels: (depth: number) => `${short(depth)} px`,
  red: "red",
  green: "green",
  blue: "blue",
};
