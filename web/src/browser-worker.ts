// Where the browser's worker begins.
import type { FromWorker, ToWorker } from "./protocol.js";
import { serve } from "./worker.js";

/** The part of a worker's global scope that is used here. */
interface WorkerScope {
  postMessage(message: FromWorker, transfer: Transferable[]): void;
  addEventListener(type: "message", listener: (event: MessageEvent<ToWorker>) => void): void;
  addEventListener(type: "unhandledrejection", listener: (event: PromiseRejectionEvent) => void): void;
}

const self = globalThis as unknown as WorkerScope;

const served = serve(
  {
    postMessage: (message, transfer) => self.postMessage(message, transfer),
    hear: (listener) => self.addEventListener("message", ({ data }) => listener(data)),
  },
  (url, fresh) => fetch(url, { cache: fresh ? "no-store" : "default" }),
);

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
