// Where the browser's worker begins.
import type { WorkerLike } from "./connection.js";
import type { FromWorker, ToWorker } from "./protocol.js";
import { serve } from "./worker.js";

/** The part of a worker's global scope that is used here. */
interface WorkerScope {
  postMessage(message: FromWorker, transfer: Transferable[]): void;
  addEventListener(type: "message", listener: (event: MessageEvent<ToWorker>) => void): void;
  addEventListener(type: "unhandledrejection", listener: (event: PromiseRejectionEvent) => void): void;
  importScripts(): void;
}

const self = globalThis as unknown as WorkerScope;

const served = serve(
  {
    postMessage: (message, transfer) => self.postMessage(message, transfer),
    hear: (listener) => self.addEventListener("message", ({ data }) => listener(data)),
  },
  {
    fetchAsset: (url, fresh) => fetch(url, { cache: fresh ? "no-store" : "default" }),
    cores: globalThis.navigator.hardwareConcurrency ?? 1,
    startHelper,
  },
);

/** Another of this worker, from where this one came: so bundlers need not know. */
function startHelper(): WorkerLike {
  return new Worker(globalThis.location.href, { type: isModule() ? "module" : "classic" });
}

/** Some bundlers make a classic worker of this. */
function isModule(): boolean {
  try {
    self.importScripts();
    return false;
  } catch {
    return true;
  }
}

// Calls into the module that were under way when it broke down never end by themselves.
self.addEventListener("unhandledrejection", ({ reason }) => served.crashed(String(reason)));

// A worker that ends says nothing, but its locks are let go: who waits for this one hears of the end at once.
// Without a secure context there are no locks.
const lock = `normalight ${Math.random()} ${performance.now()}`;
globalThis.navigator.locks
  ?.request(lock, () => {
    self.postMessage({ event: "alive", lock }, []);
    return new Promise(() => undefined);
  })
  .catch(() => undefined);
