/** How many times smaller the sides of photographs become. */
export type Shrinking = 1 | 2 | 4;

/** At which size photographs were taken, in words; none for the full one. @param whole their size before */
export function sizeWords(times: Shrinking, whole: string): string {
  return times === 1 ? "" : `at ${times === 2 ? "half" : "a quarter of"} their size, from ${whole} pixels`;
}

/** To the worker: a picture and how many times smaller its sides become. */
export interface ToShrink {
  readonly file: File;
  readonly times: Shrinking;
}

/** From the worker: a PNG, or what is wrong. */
export type Shrunk = { readonly png: Blob } | { readonly problem: string };

/**
 * Files of which those that are `chosen` are brought to a smaller size, as PNG of 8 bits sRGB.
 *
 * @param told hears of every one that is done
 */
export async function shrunk(
  files: readonly File[],
  chosen: ReadonlySet<File>,
  times: Shrinking,
  signal: AbortSignal,
  told: (done: number, of: number) => void,
): Promise<File[]> {
  if (times === 1) return [...files];
  const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  const taken: File[] = [];
  let done = 0;
  try {
    for (const file of files) {
      if (!chosen.has(file)) {
        taken.push(file);
        continue;
      }
      told(done, chosen.size);
      const png = await ask(worker, { file, times }, signal);
      taken.push(new File([png], asPng(file.name), { type: "image/png", lastModified: file.lastModified }));
      done += 1;
    }
    return taken;
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

function ask(worker: Worker, request: ToShrink, signal: AbortSignal): Promise<Blob> {
  return new Promise((resolve, reject) => {
    const cannot = (reason: string) =>
      reject(new Error(`${request.file.name}: cannot be made smaller: ${reason}`));
    signal.throwIfAborted();
    signal.addEventListener("abort", () => reject(signal.reason), { once: true });
    worker.onmessage = ({ data }: MessageEvent<Shrunk>) =>
      "png" in data ? resolve(data.png) : cannot(data.problem);
    worker.onerror = (event) => {
      event.preventDefault();
      cannot(event.message || "out of memory");
    };
    worker.postMessage(request);
  });
}
