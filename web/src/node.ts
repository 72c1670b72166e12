/**
 * What {@link index.ts} is for browsers, for Node.js: on the processor, in a thread of its own.
 *
 * @packageDocumentation
 */

import { node } from "./node-platform.js";
import { Normalight as InBrowser } from "./normalight.js";
import type { Platform } from "./platform.js";

export { type ErrorCode, type ErrorKind, NormalightError } from "./errors.js";
export * from "./types.js";

/** Estimates lights and surface normals in a thread of its own. */
export class Normalight extends InBrowser {
  /** @internal */
  protected static override readonly platform: Platform = node;
}
