import { context } from "../dom.js";
import { texts } from "../texts/texts.js";

export { short } from "../texts/numbers.js";

import type { Channel, Picture } from "./picture.js";

/** Pixels that are counted at most: enough for the shape of a histogram, and quick at any size. */
const SAMPLES = 40_000;

/** How the values of a channel are spread. */
export interface Spread {
  /** Share of the pixels in each of the bins. */
  readonly bins: Float32Array;
  /** How many pixels were counted. */
  readonly count: number;
  readonly mean: number;
  readonly lowest: number;
  readonly highest: number;
}

/** Counts the values of a channel in evenly wide bins; what lies beyond the range is in the first or last one. */
export function spreadOf(
  channel: Pick<Channel, "at">,
  pixels: number,
  [low, high]: readonly [number, number],
  binCount: number,
): Spread {
  const bins = new Float32Array(binCount);
  // Odd, so that it does not fall on the same columns of every row.
  const step = Math.max(1, Math.ceil(pixels / SAMPLES)) | 1;
  let [count, sum, lowest, highest] = [0, 0, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (let pixel = 0; pixel < pixels; pixel += step) {
    const value = channel.at(pixel);
    if (Number.isNaN(value)) continue;
    const bin = Math.floor(((value - low) / (high - low)) * binCount);
    const index = Math.min(Math.max(bin, 0), binCount - 1);
    bins[index] = (bins[index] ?? 0) + 1;
    count += 1;
    sum += value;
    lowest = Math.min(lowest, value);
    highest = Math.max(highest, value);
  }
  if (count > 0) for (const [index, value] of bins.entries()) bins[index] = value / count;
  return { bins, count, mean: count > 0 ? sum / count : Number.NaN, lowest, highest };
}

/** The spread of a channel in words. */
export function spreadWords(name: string, spread: Spread): string {
  return texts.viewer.spread(name, spread);
}

/** Draws the histogram of a picture, and says it in words. */
export function drawHistogram(canvas: HTMLCanvasElement, picture: Picture): string {
  const { width, height } = canvas;
  const drawing = context(canvas);
  const spreads = picture.channels.map((channel) => ({
    channel,
    spread: spreadOf(channel, picture.width * picture.height, picture.range, 64),
  }));
  // The tallest bins are cut off where they would flatten all others.
  const tallest = Math.max(...spreads.map(({ spread }) => tall(spread.bins)), 1e-6);
  drawing.clearRect(0, 0, width, height);
  drawing.globalCompositeOperation = "lighter";
  for (const { channel, spread } of spreads) {
    drawing.fillStyle = channel.colour;
    drawing.globalAlpha = spreads.length > 1 ? 0.62 : 0.9;
    const wide = width / spread.bins.length;
    for (const [index, share] of spread.bins.entries()) {
      const size = Math.min(share / tallest, 1) * height;
      drawing.fillRect(index * wide, height - size, wide, size);
    }
  }
  drawing.globalAlpha = 1;
  return spreads.map(({ channel, spread }) => spreadWords(channel.name, spread)).join("; ");
}

/** The fourth tallest bin, with some room above. */
function tall(bins: Float32Array): number {
  return 1.15 * ([...bins].sort((a, b) => b - a)[3] ?? 0);
}
