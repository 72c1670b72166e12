import { NormalightError } from "./errors.js";
import type { Platform } from "./platform.js";
import type { CreateOptions } from "./types.js";

/** The folder in which Vite keeps what it bundled beforehand, without worker and module. */
const BUNDLED_BY_VITE = /\/\.vite\/deps\//;

/** Browsers. */
export const browser: Platform = {
  startWorker,
  advice,
  sendsFiles: true,
  resolve: (url) => new URL(url, globalThis.document?.baseURI ?? globalThis.location?.href).href,
  fetchAsset: (url, fresh) => fetch(url, { cache: fresh ? "no-store" : "default" }),
};

/** Starts the browser's worker. */
function startWorker({ workerUrl }: CreateOptions): Worker {
  if (typeof Worker === "undefined") {
    throw new NormalightError("unsupported", "There are no workers here: `worker: false` does without one.");
  }
  try {
    if (workerUrl !== undefined) return moduleWorker(new URL(browser.resolve(workerUrl)));
    if (fromElsewhere(import.meta.url)) {
      // No literal: a bundler's files lie on the page's own server, and a second literal would copy the worker.
      return moduleWorker(new URL(import.meta.url.replace(/[^/]*$/, "browser-worker.js")));
    }
    // A literal, so that bundlers find the worker and its parts.
    return new Worker(new URL("./browser-worker.js", import.meta.url), { type: "module" });
  } catch (error) {
    throw new NormalightError("load", `The worker cannot be started: ${error}. ${advice()}`);
  }
}

/** What helps where the worker does not start. */
function advice(): string {
  return BUNDLED_BY_VITE.test(import.meta.url)
    ? 'In vite.config, `optimizeDeps: { exclude: ["normalight"] }` keeps the package in one piece.'
    : "Is browser-worker.js where `workerUrl` or this package's other files are, and does the page's security policy allow it?";
}

/** A worker from any server: one from another must begin in a file of the page's own, which imports it. */
function moduleWorker(url: URL): Worker {
  if (!fromElsewhere(url.href)) return new Worker(url, { type: "module" });
  const text = `import ${JSON.stringify(url.href)};`;
  const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  // The address must live until the worker has read it, and costs a few bytes.
  return new Worker(address, { type: "module" });
}

function fromElsewhere(url: string): boolean {
  const { protocol, origin } = new URL(url);
  return /^https?:$/.test(protocol) && origin !== globalThis.location?.origin;
}
