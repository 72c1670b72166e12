import { ask } from "../ask.js";
import type { Frame } from "../crop/rectangle.js";
import { texts } from "../texts/texts.js";
import type { Taken } from "./taken.js";

/** To the worker: a picture, and what of it is taken. */
export interface ToTake {
  readonly file: File;
  readonly taken: Taken;
  /** Whether its codes are in proportion to light. */
  readonly linear: boolean;
}

/** Why a picture cannot be taken. */
export type TakenProblem =
  | { readonly kind: "other-size"; readonly own: Frame; readonly others: Frame }
  | { readonly kind: "no-drawing" }
  | { readonly kind: "broken"; readonly message: string };

/** From the worker: a PNG, or what is wrong. */
export type TakenPicture = { readonly png: Blob } | { readonly problem: TakenProblem };

/**
 * Files of which those that are `chosen` are cropped and brought to a smaller size, as PNG of 8 bits sRGB.
 *
 * @param told hears of every one that is done
 */
export async function shrunk(
  files: readonly File[],
  chosen: ReadonlySet<File>,
  taken: Taken,
  linear: boolean,
  signal: AbortSignal,
  told: (done: number, of: number) => void,
): Promise<File[]> {
  if (taken.times === 1 && !taken.crop) return [...files];
  const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  const words = taken.crop ? texts.large.notCropped : texts.large.notShrunk;
  const used: File[] = [];
  let done = 0;
  try {
    for (const file of files) {
      if (!chosen.has(file)) {
        used.push(file);
        continue;
      }
      told(done, chosen.size);
      const request: ToTake = { file, taken, linear };
      const cannot = (why: string) => words(file.name, why);
      const answer = await ask<TakenPicture>(worker, request, cannot, signal);
      if ("problem" in answer) throw new Error(cannot(wordsFor(answer.problem)));
      const name = asPng(file.name);
      used.push(new File([answer.png], name, { type: "image/png", lastModified: file.lastModified }));
      done += 1;
    }
    return used;
  } finally {
    worker.terminate();
  }
}

/** A name that says what the content is. */
export function asPng(name: string): string {
  return `${withoutExtension(name)}.png`;
}

/** A name without what says its format. */
export function withoutExtension(name: string): string {
  return name.replace(/\.[^./]*$/, "");
}

function wordsFor(problem: TakenProblem): string {
  switch (problem.kind) {
    case "other-size":
      return texts.large.otherSize(problem.own, problem.others);
    case "no-drawing":
      return texts.errors.noDrawing;
    case "broken":
      return problem.message;
  }
}
