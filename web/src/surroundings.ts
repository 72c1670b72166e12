import type { WorkerLike } from "./connection.js";
import type { FetchAsset } from "./fetch.js";

/** What who computes finds around itself. */
export interface Surroundings {
  /** Fetches modules and weights. */
  readonly fetchAsset: FetchAsset;
  /** How many threads can compute at once. */
  readonly cores: number;
  /** Starts another worker like this one; nothing where there can be none. */
  readonly startHelper?: () => WorkerLike;
}
