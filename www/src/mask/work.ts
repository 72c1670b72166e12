import { texts } from "../texts/texts.js";
import type { FromMaskWorker, MaskTask, MaskTasks } from "./protocol.js";

interface Waiting {
  resolve(response: unknown): void;
  reject(error: Error): void;
}

/** The editor's worker, call by call. */
export class MaskWork {
  readonly #worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  readonly #waiting = new Map<number, Waiting>();
  #last = 0;

  constructor() {
    this.#worker.addEventListener("message", ({ data }: MessageEvent<FromMaskWorker>) => {
      const waiting = this.#waiting.get(data.id);
      this.#waiting.delete(data.id);
      if ("problem" in data) waiting?.reject(new Error(texts.mask.problem(data.problem)));
      else waiting?.resolve(data.response);
    });
    this.#worker.addEventListener("error", (event) => {
      event.preventDefault();
      this.#fail(texts.mask.stopped(event.message || texts.large.outOfMemory));
    });
  }

  /** Does something in the worker; buffers in `transfer` are handed over. */
  do<T extends MaskTask>(
    task: T,
    request: MaskTasks[T]["request"],
    transfer: Transferable[] = [],
  ): Promise<MaskTasks[T]["response"]> {
    this.#last += 1;
    const id = this.#last;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve: resolve as (response: unknown) => void, reject });
      this.#worker.postMessage({ id, task, request }, transfer);
    });
  }

  close(): void {
    this.#worker.terminate();
    this.#fail(texts.mask.closed);
  }

  #fail(words: string): void {
    for (const { reject } of this.#waiting.values()) reject(new Error(words));
    this.#waiting.clear();
  }
}
