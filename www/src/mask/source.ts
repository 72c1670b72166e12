import type { ColorMode, Normalight, StackFile } from "normalight";

/** The mask of a stack, as the estimator would take it. */
export interface FoundMask {
  readonly width: number;
  readonly height: number;
  /** 0 or 255 for each pixel. */
  readonly inside: Uint8Array;
  /** Where it came from, in words. */
  readonly words: string;
}

interface MaskOptions {
  readonly color?: ColorMode;
  readonly mask?: "auto" | "none" | StackFile;
}

/** What the package may offer beyond its types. */
interface WithMask {
  mask?(files: readonly StackFile[], options: MaskOptions): Promise<FoundMask>;
}

/** The mask that an estimation would take; nothing where the package does not tell. */
export async function maskOf(
  normalight: Normalight,
  files: readonly StackFile[],
  options: MaskOptions,
): Promise<FoundMask | undefined> {
  const teller = normalight as unknown as WithMask;
  return await teller.mask?.(files, options);
}

/** A mask in a frame of another size, by the nearest pixel. */
export function scaled({ width, height, inside }: FoundMask, toWidth: number, toHeight: number): Uint8Array {
  if (width === toWidth && height === toHeight) return inside;
  const columns = Int32Array.from({ length: toWidth }, (_, x) => Math.floor(((x + 0.5) * width) / toWidth));
  const mask = new Uint8Array(toWidth * toHeight);
  for (let y = 0; y < toHeight; y++) {
    const from = Math.floor(((y + 0.5) * height) / toHeight) * width;
    for (let x = 0; x < toWidth; x++) mask[y * toWidth + x] = inside[from + (columns[x] ?? 0)] ?? 0;
  }
  return mask;
}
