import type { WorkerLike } from "./connection.js";
import type { FetchAsset } from "./fetch.js";
import type { FromWorker, ToWorker } from "./protocol.js";
import { serve } from "./worker.js";

/** A worker that is none: its messages come from and go to the same thread. */
export function startHere(fetchAsset: FetchAsset): WorkerLike {
  let listener: (message: ToWorker) => void = () => undefined;
  let ended = false;
  // A message arrives later, as if it came from elsewhere.
  const later = (deliver: () => void) => queueMicrotask(() => ended || deliver());
  const served = serve(
    {
      postMessage: (message: FromWorker) => later(() => worker.onmessage?.({ data: message })),
      hear(heard) {
        listener = heard;
      },
    },
    // Who wants no worker gets none as helper, either.
    { fetchAsset, cores: 1 },
  );
  const worker: WorkerLike = {
    onmessage: null,
    onerror: null,
    postMessage: (message: ToWorker) => later(() => listener(message)),
    terminate() {
      ended = true;
      served.stop();
    },
  };
  return worker;
}
