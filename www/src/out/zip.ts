import { Zip, ZipDeflate, ZipPassThrough, type Zippable, zipSync } from "fflate";
import type { Kept } from "../downloads.js";
import { texts } from "../texts/texts.js";

/** What gets smaller by packing; numbers and pictures hardly do, and would keep the page waiting. */
const PACKED = /\.(csv|lp|svg|json|obj|mtl|html)$/;

/** One archive of files. */
export function zipOf(files: readonly Kept[]): Uint8Array<ArrayBuffer> {
  const entries: Zippable = {};
  for (const { name, bytes } of files) entries[name] = [bytes, { level: PACKED.test(name) ? 6 : 0 }];
  return zipSync(entries);
}

/** Bytes of the largest archive of this kind: places in it are numbers of 32 bits. */
const MOST = 2 ** 32 - 1;

/** One archive of files in folders, which come one after the other: never are all of them in memory. */
export async function zipOfFolders(
  folders: AsyncIterable<{ readonly folder: string; readonly files: readonly Kept[] }>,
): Promise<Blob> {
  const parts: Blob[] = [];
  let size = 0;
  const zip = new Zip((error, part) => {
    if (error) throw error;
    parts.push(new Blob([part as Uint8Array<ArrayBuffer>]));
    size += part.length;
  });
  for await (const { folder, files } of folders) {
    for (const { name, bytes } of files) {
      const path = `${folder}/${name}`;
      const entry = PACKED.test(name) ? new ZipDeflate(path, { level: 6 }) : new ZipPassThrough(path);
      zip.add(entry);
      entry.push(bytes, true);
    }
    if (size > MOST) throw new Error(texts.out.tooLarge);
  }
  zip.end();
  return new Blob(parts, { type: "application/zip" });
}
