import { capturesAmong, type Found, type Placed } from "./captures.js";

/** Folders within folders that are searched; deeper ones are hardly a capture. */
const DEPTH = 6;

/** Most files that are looked at: whoever drops a whole disk gets an answer, too. */
const MOST = 20_000;

/** What was dropped: files, folders, and the folders in them. */
export async function filesOfDrop(transfer: DataTransfer): Promise<Found> {
  // Entries must be taken before the first wait: afterwards the browser forgets the drop.
  const entries = [...transfer.items]
    .map((item) => item.webkitGetAsEntry?.())
    .filter((entry) => entry != null);
  if (entries.length === 0)
    return capturesAmong(
      [...transfer.files].map((file) => ({ folder: "", file })),
      [],
    );
  const placed: Placed[] = [];
  for (const entry of entries) await gather(entry, "", DEPTH, placed);
  return capturesAmong(
    placed,
    entries.filter(({ isDirectory }) => isDirectory).map(({ name }) => name),
  );
}

/** What a chosen folder holds; browsers hand out the files of all folders in it. */
export function filesOfFolder(chosen: readonly File[]): Found {
  const placed = chosen.map((file) => ({ folder: file.webkitRelativePath.replace(/\/?[^/]*$/, ""), file }));
  const top = placed[0]?.folder.split("/")[0];
  return top ? capturesAmong(placed, [top]) : { captures: [], told: { kind: "empty-folder" } };
}

/** Files under names that none of the others has: pictures of the clipboard are all called the same. */
export function numbered(files: readonly File[], others: readonly File[]): File[] {
  const taken = new Set(others.map(({ name }) => name));
  return files.map((file) => {
    let name = file.name;
    for (let number = 2; taken.has(name); number++) name = file.name.replace(/(\.[^.]*)?$/, ` ${number}$1`);
    taken.add(name);
    return new File([file], name, { type: file.type });
  });
}

async function gather(
  entry: FileSystemEntry,
  folder: string,
  depth: number,
  placed: Placed[],
): Promise<void> {
  if (placed.length >= MOST) return;
  if (entry.isFile) {
    placed.push({ folder, file: await fileOf(entry as FileSystemFileEntry) });
    return;
  }
  if (depth === 0) return;
  const path = folder ? `${folder}/${entry.name}` : entry.name;
  for (const child of await childrenOf(entry as FileSystemDirectoryEntry))
    await gather(child, path, depth - 1, placed);
}

function fileOf(entry: FileSystemFileEntry): Promise<File> {
  return new Promise((resolve, reject) => entry.file(resolve, reject));
}

async function childrenOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const all: FileSystemEntry[] = [];
  // Browsers hand out a hundred or so at a time, and nothing at the end.
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) =>
      reader.readEntries(resolve, reject),
    );
    if (some.length === 0) return all;
    all.push(...some);
  }
}
