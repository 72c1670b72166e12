import { texts } from "./texts/texts.js";

/**
 * Asks a worker that answers one request after the other, and waits for its answer.
 *
 * @param stopped makes the words of an error where the worker ends without one
 */
export async function ask<Answer>(
  worker: Worker,
  request: unknown,
  stopped: (why: string) => string,
  signal?: AbortSignal,
): Promise<Answer> {
  signal?.throwIfAborted();
  // One signal may follow hundreds of questions.
  const answered = new AbortController();
  try {
    return await new Promise((resolve, reject) => {
      const stop = () => reject(signal?.reason);
      signal?.addEventListener("abort", stop, { once: true, signal: answered.signal });
      worker.onmessage = ({ data }: MessageEvent<Answer>) => resolve(data);
      worker.onerror = (event) => {
        event.preventDefault();
        reject(new Error(stopped(event.message || texts.large.outOfMemory)));
      };
      worker.postMessage(request);
    });
  } finally {
    answered.abort();
  }
}
