import type { WorkerLike } from "./connection.js";
import type { FetchAsset } from "./fetch.js";
import type { CreateOptions } from "./types.js";

/** What browsers and Node.js do each in their own way. */
export interface Platform {
  /** A worker that {@link WorkerLike} describes; fails in words where there can be none. */
  startWorker(options: CreateOptions): WorkerLike;
  /** What helps where a worker does not start. */
  advice(): string;
  /** Whether a worker here understands the browser's files. */
  readonly sendsFiles: boolean;
  /** An absolute address. */
  resolve(url: string | URL): string;
  /** Fetches modules and weights for who computes without a worker. */
  readonly fetchAsset: FetchAsset;
}
