/** Steps of the table from linear light to 8-bit sRGB. */
export const STEPS = 4096;

/** 8-bit sRGB of linear light in so many steps. */
export const ENCODED = encodedBy(STEPS);

/** Linear light of 8-bit sRGB. */
export const DECODED = Float32Array.from({ length: 256 }, (_, code) => {
  const encoded = code / 255;
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
});

/** 8-bit sRGB of linear light, cut off at white. */
export function encode(linear: number): number {
  return ENCODED[Math.round(Math.min(Math.max(linear, 0), 1) * STEPS)] ?? 0;
}

/** Linear light of a code of 8-bit sRGB. */
export function decode(code: number): number {
  return DECODED[code] ?? 0;
}

/** A table from linear light to 8-bit sRGB, rounded, in so many steps. */
export function encodedBy(steps: number): Uint8ClampedArray<ArrayBuffer> {
  return Uint8ClampedArray.from({ length: steps + 1 }, (_, step) => {
    const linear = step / steps;
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
  });
}
