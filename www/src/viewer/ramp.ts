/** Colours from low to high: each lighter than the one before, so that they also read without colour. */
const STOPS = [
  [18, 19, 31],
  [49, 42, 120],
  [31, 118, 168],
  [60, 190, 150],
  [214, 222, 92],
  [255, 247, 205],
] as const;

/** The colour of a value in 0..1. */
export function ramp(value: number): readonly [number, number, number] {
  const place = Math.min(Math.max(value, 0), 1) * (STOPS.length - 1);
  const index = Math.min(Math.floor(place), STOPS.length - 2);
  const [low, high] = [STOPS[index] ?? STOPS[0], STOPS[index + 1] ?? STOPS[0]];
  const mixed = (channel: 0 | 1 | 2) => low[channel] + (place - index) * (high[channel] - low[channel]);
  return [mixed(0), mixed(1), mixed(2)];
}

/** Numbers as colours between two values, clear where there is no number. */
export function ramped(map: Float32Array, [low, high]: readonly [number, number]): Uint8Array<ArrayBuffer> {
  const rgba = new Uint8Array(4 * map.length);
  const colours = Array.from({ length: 256 }, (_, index) => ramp(index / 255));
  for (const [pixel, value] of map.entries()) {
    if (Number.isNaN(value)) continue;
    const share = Math.min(Math.max((value - low) / (high - low || 1), 0), 1);
    rgba.set(colours[Math.round(255 * share)] ?? [0, 0, 0], 4 * pixel);
    rgba[4 * pixel + 3] = 255;
  }
  return rgba;
}

/** Numbers as grey between two values, clear where there is no number. */
export function greyed(map: Float32Array, [low, high]: readonly [number, number]): Uint8Array<ArrayBuffer> {
  const rgba = new Uint8Array(4 * map.length);
  for (const [pixel, value] of map.entries()) {
    if (Number.isNaN(value)) continue;
    const code = 255 * Math.min(Math.max((value - low) / (high - low || 1), 0), 1);
    rgba.set([code, code, code, 255], 4 * pixel);
  }
  return rgba;
}

/** The value that a share of all numbers lies below; of an even choice where there are many. */
export function quantile(map: Float32Array, share: number): number {
  const step = Math.max(1, Math.floor(map.length / 100_000));
  const some: number[] = [];
  for (let pixel = 0; pixel < map.length; pixel += step) {
    const value = map[pixel] ?? Number.NaN;
    if (!Number.isNaN(value)) some.push(value);
  }
  some.sort((a, b) => a - b);
  return some[Math.min(Math.floor(share * some.length), some.length - 1)] ?? 0;
}
