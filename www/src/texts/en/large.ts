import type { Crop, Frame } from "../../crop/rectangle.js";
import { fixed } from "../numbers.js";
import { crop as rectangles } from "./crop.js";

function memory(bytes: number): string {
  return `${fixed(bytes / 2 ** 30, 1)} GB`;
}

function duration(seconds: number): string {
  if (seconds < 90) return `about ${10 * Math.ceil(seconds / 10)} s`;
  if (seconds < 5400) return `about ${Math.round(seconds / 60)} min`;
  return `about ${Math.round(seconds / 3600)} h`;
}

export const large = {
  size: "Size of the photographs",
  full: "Full",
  half: "Half",
  quarter: "Quarter",
  /** What a run costs; the seconds where they can be known, and whether this computer has shown its speed. */
  cost: (
    photographs: number,
    pixels: number,
    cropped: boolean,
    bytes: number,
    time: { readonly seconds: number; readonly measured: boolean } | undefined,
  ) => {
    const known = time?.measured
      ? ", as fast as the last run was"
      : ", if this processor is like ours and the object fills half of the frame";
    const when = time
      ? `${duration(time.seconds)}${known}`
      : "how long it takes here is known after the first run";
    return `${photographs} photographs of ${fixed(pixels / 1e6, 1)} megapixels${cropped ? " after cropping" : ""}: about ${memory(bytes)} of memory; ${when}.`;
  },
  lacking: (here: number) =>
    `That is more than the ${memory(here)} that a page has: the run may fail. The command has no such limit.`,
  noMemory: (here: number) =>
    `More memory than there is for a page (${memory(here)}) would be needed for the full size.`,
  fixed: {
    deep: "has 16 bits a sample, of which browsers keep 8",
    undecoded: "is of a format that browsers do not decode",
  },
  cropping: (photograph: number, of: number) => `Cropping photographs: ${photograph} of ${of}`,
  shrinking: (photograph: number, of: number) => `Making photographs smaller: ${photograph} of ${of}`,
  croppingMask: "Cropping the mask",
  notCropped: (file: string, reason: string) => `${file}: cannot be cropped: ${reason}`,
  notShrunk: (file: string, reason: string) => `${file}: cannot be made smaller: ${reason}`,
  otherSize: (own: Frame, others: Frame) =>
    `it has ${own.width} × ${own.height} pixels, others have ${others.width} × ${others.height}`,
  outOfMemory: "out of memory",
  /** How photographs were taken. */
  taken: (crop: Crop | undefined, times: 1 | 2 | 4, frame: Frame | undefined) => {
    const part = crop ? [`cropped to ${rectangles.rectangle(crop)}`] : [];
    const size = times === 1 ? [] : [`at ${times === 2 ? "half" : "a quarter of"} their size`];
    const words = [...part, ...size].join(", ");
    return words && frame ? `${words}, from ${frame.width} × ${frame.height} pixels` : words;
  },
  planLine: (taken: string) => `photographs: taken ${taken}, as PNG of 8 bits that the page made of them`,
};
