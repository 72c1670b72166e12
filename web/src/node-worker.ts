// Where Node's thread begins.
import { availableParallelism } from "node:os";
import { parentPort } from "node:worker_threads";
import { fetchAsset, startWorker } from "./node-platform.js";
import { serve } from "./worker.js";

const port = parentPort;
if (port === null) throw new Error("node-worker.js is a worker's file");

const served = serve(
  {
    postMessage: (message, transfer) => port.postMessage(message, transfer),
    hear: (listener) => port.on("message", listener),
  },
  { fetchAsset, cores: availableParallelism(), startHelper: startWorker },
);

// Calls into the module that were under way when it broke down never end by themselves.
process.on("unhandledRejection", (reason) => served.crashed(String(reason)));
