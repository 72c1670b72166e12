import { type Zippable, zipSync } from "fflate";
import type { Kept } from "../downloads.js";

/** What gets smaller by packing; numbers and pictures hardly do, and would keep the page waiting. */
const PACKED = /\.(csv|lp|svg|json|obj|mtl|html)$/;

/** One archive of files. */
export function zipOf(files: readonly Kept[]): Uint8Array<ArrayBuffer> {
  const entries: Zippable = {};
  for (const { name, bytes } of files) entries[name] = [bytes, { level: PACKED.test(name) ? 6 : 0 }];
  return zipSync(entries);
}
