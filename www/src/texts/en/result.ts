import type { Estimate, MaskReport, Quality } from "normalight";
import { fixed, percent, whole } from "../numbers.js";

type Errors = NonNullable<Estimate["trueErrors"]>;

export const result = {
  title: "Result",
  titleOf: (name: string) => `Result of ${name}`,
  stale: (name: string) =>
    `This is the result of ${name === "" ? "the photographs before" : name}. The photographs have changed since; a new run replaces it.`,
  none: "there is no result",
  photographs: "Photographs",
  size: (photographs: number, width: number, height: number, taken: string) =>
    `${photographs} of ${width} × ${height} pixels${taken && `, ${taken}`}`,
  mask: "Mask",
  maskOf: ({ words, pixels }: MaskReport) => `${words}, ${whole(pixels)} pixels`,
  device: "Device",
  deviceOf: (device: string, threads: number) => (threads > 1 ? `${device} · ${threads} threads` : device),
  quality: "Quality",
  qualityOf: (quality: Quality): string => quality,
  expected: "Errors to expect",
  expectedLights: (degrees: number) => `lights ${fixed(degrees, 0)}°`,
  expectedNormals: (degrees: number) => `normals ${fixed(degrees, 0)}°`,
  unknown: "unknown",
  errors: "Errors",
  errorsOf: ({ file, mean, median, shares }: Errors) =>
    `normals, against ${file}: ${fixed(mean, 2)}° on average, ${fixed(median, 2)}° in the median, ${percent(shares[0])} % under 11.25°`,
  time: "Time",
  seconds: (seconds: number) => `${fixed(seconds, 2)} s`,
  stageSeconds: (seconds: number) => fixed(seconds, 2),
  plan: "What was taken for what",
  secondsTitle: "Seconds per stage",
};
