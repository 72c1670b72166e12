import { texts } from "./texts/texts.js";

/**
 * Asks a worker that answers one request after the other, and waits for its answer.
 *
 * @param stopped makes the words of an error where the worker ends without one
 */
export function ask<Answer>(
  worker: Worker,
  request: unknown,
  stopped: (why: string) => string,
  signal?: AbortSignal,
): Promise<Answer> {
  return new Promise((resolve, reject) => {
    signal?.throwIfAborted();
    signal?.addEventListener("abort", () => reject(signal.reason), { once: true });
    worker.onmessage = ({ data }: MessageEvent<Answer>) => resolve(data);
    worker.onerror = (event) => {
      event.preventDefault();
      reject(new Error(stopped(event.message || texts.large.outOfMemory)));
    };
    worker.postMessage(request);
  });
}
