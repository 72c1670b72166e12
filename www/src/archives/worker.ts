import { type UnzipFileInfo, unzipSync } from "fflate";
import { capturesAmong, type Found, type Place, type Placed } from "../captures.js";

/** What is wrong with archives. */
export type ArchiveProblem =
  | { readonly kind: "too-large"; readonly place: Place; readonly gigabytes: number }
  | { readonly kind: "broken"; readonly message: string };

/** From the worker: the captures, where there are several, or what is wrong. */
export type FromArchives = { readonly found: Found | undefined } | { readonly problem: ArchiveProblem };

/** The part of a worker's global scope that is used here. */
interface Scope {
  postMessage(message: FromArchives): void;
  addEventListener(type: "message", listener: (event: MessageEvent<File[]>) => void): void;
}

const scope = self as unknown as Scope;

/** Largest archive that is looked into: it is read at once. */
const MOST = 1.9e9;
/** Most that is unpacked of all. */
const MOST_UNPACKED = 16e9;

/** A file in an archive, where it is found again. */
interface Listed extends UnzipFileInfo {
  readonly archive: number;
}

scope.addEventListener("message", async ({ data }) => {
  try {
    scope.postMessage(await look(data));
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    scope.postMessage({ problem: { kind: "broken", message } });
  }
});

async function look(archives: readonly File[]): Promise<FromArchives> {
  if (archives.some(({ size }) => size > MOST)) return { found: undefined };
  const listed = new Map<File, Listed>();
  const placed: Placed[] = [];
  for (const [archive, { name: archiveName }] of archives.entries()) {
    const top = archiveName.replace(/\.zip$/i, "");
    const infos = list(await bytesOf(archives, archive));
    // The estimator says what is wrong with it.
    if (!infos) return { found: undefined };
    for (const info of infos) {
      const parts = info.name.split("/");
      const name = parts.pop() ?? "";
      if (name === "") continue;
      const folder = [...(archives.length > 1 ? [top] : []), ...parts].join("/") || top;
      // Empty as yet: most archives hold one capture, and are not unpacked here.
      const file = new File([], name);
      listed.set(file, { ...info, archive });
      placed.push({ folder, file });
    }
  }
  const place: Place = { kind: "archives", names: archives.map(({ name }) => name) };
  const { captures, ...others } = capturesAmong(placed, [], place);
  if (captures.length < 2) return { found: undefined };
  const wanted = captures.flatMap(({ files }) => files);
  const needed = wanted.reduce((sum, file) => sum + (listed.get(file)?.originalSize ?? 0), 0);
  if (needed > MOST_UNPACKED)
    return { problem: { kind: "too-large", place, gigabytes: MOST_UNPACKED / 1e9 } };
  const unpacked = await unpack(archives, wanted, listed);
  const filled = captures.map(({ folder, files }) => ({
    folder,
    files: files.flatMap((file) => unpacked.get(file) ?? []),
  }));
  return { found: { captures: filled, ...others } };
}

/** The wanted files with their contents: one after the other, so that they are not in memory all at once. */
async function unpack(
  archives: readonly File[],
  wanted: readonly File[],
  listed: ReadonlyMap<File, Listed>,
): Promise<Map<File, File>> {
  const unpacked = new Map<File, File>();
  for (const archive of archives.keys()) {
    const bytes = await bytesOf(archives, archive);
    for (const file of wanted) {
      const info = listed.get(file);
      if (info?.archive !== archive) continue;
      const content = unzipSync(bytes, { filter: ({ name }) => name === info.name })[info.name];
      if (content) unpacked.set(file, new File([content as Uint8Array<ArrayBuffer>], file.name));
    }
  }
  return unpacked;
}

/** What an archive holds; nothing where that cannot be read. */
function list(bytes: Uint8Array): UnzipFileInfo[] | undefined {
  const found: UnzipFileInfo[] = [];
  try {
    unzipSync(bytes, {
      filter(info) {
        found.push(info);
        return false;
      },
    });
    return found;
  } catch {
    return undefined;
  }
}

async function bytesOf(archives: readonly File[], index: number): Promise<Uint8Array> {
  return new Uint8Array((await archives[index]?.arrayBuffer()) ?? []);
}
