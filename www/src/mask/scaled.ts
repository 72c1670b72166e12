import type { ObjectMask } from "normalight";

/** A mask in a frame of another size, by the nearest pixel. */
export function scaled(
  { width, height, inside }: Pick<ObjectMask, "width" | "height" | "inside">,
  toWidth: number,
  toHeight: number,
): Uint8Array {
  if (width === toWidth && height === toHeight) return inside;
  const columns = Int32Array.from({ length: toWidth }, (_, x) => Math.floor(((x + 0.5) * width) / toWidth));
  const mask = new Uint8Array(toWidth * toHeight);
  for (let y = 0; y < toHeight; y++) {
    const from = Math.floor(((y + 0.5) * height) / toHeight) * width;
    for (let x = 0; x < toWidth; x++) mask[y * toWidth + x] = inside[from + (columns[x] ?? 0)] ?? 0;
  }
  return mask;
}
