import { readFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";
import { setFlagsFromString } from "node:v8";
import { Worker } from "node:worker_threads";
import type { WorkerLike } from "./connection.js";
import type { Platform } from "./platform.js";
import type { FromWorker } from "./protocol.js";

/** Node.js. */
export const node: Platform = {
  startWorker,
  advice: () =>
    'Where a bundler has moved this package, it must leave it alone: `serverExternalPackages: ["normalight"]` in next.config.',
  // A file is another thing on the other side of a thread.
  sendsFiles: false,
  resolve: (url) => (/^[a-z]{2,}:/i.test(String(url)) ? String(url) : pathToFileURL(String(url)).href),
  fetchAsset,
};

/** A module or weights from the disk or a server, between which and us there is no cache. */
export async function fetchAsset(url: string): Promise<Response> {
  // Node.js 20 can do what the module needs, but does not yet do so unasked.
  if (process.versions.node.startsWith("20.")) setFlagsFromString("--experimental-wasm-relaxed-simd");
  if (!url.startsWith("file:")) return await fetch(url);
  const bytes = new Uint8Array(await readFile(new URL(url)));
  return new Response(bytes, { headers: { "Content-Length": String(bytes.length) } });
}

/** A thread, as a browser's worker is spoken to. */
export function startWorker(): WorkerLike {
  // The program's own flags, of loaders or how it was given, are none of this thread's.
  const thread = new Worker(new URL("./node-worker.js", import.meta.url), { execArgv: [] });
  const worker: WorkerLike = {
    onmessage: null,
    onerror: null,
    postMessage(message) {
      // Who never closes it must not wait for it at the end of the program: it counts as long as it has a task.
      thread.ref();
      thread.postMessage(message);
    },
    terminate: () => void thread.terminate(),
  };
  thread.on("message", (data: FromWorker) => {
    if (data.event === "done" || data.event === "failed") thread.unref();
    worker.onmessage?.({ data });
  });
  const fail = (message: string) => worker.onerror?.({ message });
  thread.on("error", (error) => fail(error.message));
  thread.on("exit", (code) => fail(`the thread ended with code ${code}`));
  return worker;
}
