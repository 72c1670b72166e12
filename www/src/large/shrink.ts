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
  const used: File[] = [];
  let done = 0;
  try {
    for (const file of files) {
      if (!chosen.has(file)) {
        used.push(file);
        continue;
      }
      told(done, chosen.size);
      const png = await ask(worker, { file, taken, linear }, signal);
      used.push(new File([png], asPng(file.name), { type: "image/png", lastModified: file.lastModified }));
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

function ask(worker: Worker, request: ToTake, signal: AbortSignal): Promise<Blob> {
  return new Promise((resolve, reject) => {
    const words = request.taken.crop ? texts.large.notCropped : texts.large.notShrunk;
    const cannot = (reason: string) => reject(new Error(words(request.file.name, reason)));
    signal.throwIfAborted();
    signal.addEventListener("abort", () => reject(signal.reason), { once: true });
    worker.onmessage = ({ data }: MessageEvent<TakenPicture>) =>
      "png" in data ? resolve(data.png) : cannot(wordsFor(data.problem));
    worker.onerror = (event) => {
      event.preventDefault();
      cannot(event.message || texts.large.outOfMemory);
    };
    worker.postMessage(request);
  });
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
