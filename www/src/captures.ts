/** A file and the folder that it lies in, as a path; empty for files that were dropped by themselves. */
export interface Placed {
  readonly folder: string;
  readonly file: File;
}

/** Files that may be one stack. */
export interface Capture {
  readonly folder: string;
  readonly files: readonly File[];
}

/** Where captures were looked for: folders or archives, by their names. */
export interface Place {
  readonly kind: "folders" | "archives";
  readonly names: readonly string[];
}

/** What people must know about what was found. */
export type Told =
  | { readonly kind: "several"; readonly count: number; readonly place: Place; readonly taken: string }
  | { readonly kind: "nested"; readonly folder: string }
  | { readonly kind: "one-in-each"; readonly folders: number }
  | { readonly kind: "no-photographs"; readonly place: Place; readonly others: number }
  | { readonly kind: "empty-folder" };

/** What a drop may mean: the first is taken, the others are offered. A worker says it, too, so it has no words. */
export interface Found {
  readonly captures: readonly Capture[];
  /** Nothing where everything is as expected. */
  readonly told?: Told;
}

/** Fewest photographs of a stack. */
export const FEWEST = 3;

/** Extensions of files that are surely no photographs. The content decides later, this is only for the search. */
const OTHER =
  /(^|\/)(\.|thumbs\.db$|desktop\.ini$)|\.(txt|csv|tsv|json|lp|npy|mat|md|xml|xmp|html?|svg|log|obj|ply|glb)$/i;

/** Whether a file is surely no photograph. */
export function isOther({ name }: File): boolean {
  return OTHER.test(name);
}

const mayBePhotograph = (file: File) => !isOther(file);

/**
 * The stacks among dropped files: those in the dropped folder itself, as on the command line; where there are too few,
 * those in the folders below it.
 *
 * @param tops names of the dropped folders
 * @param place where all of them lie
 */
export function capturesAmong(
  placed: readonly Placed[],
  tops: readonly string[],
  place: Place = { kind: "folders", names: tops },
): Found {
  const folders = byFolder(placed);
  const loose = folders.get("");
  const direct = tops.flatMap((top) => folders.get(top) ?? []);
  // Files that were dropped together belong together.
  if (loose) return { captures: [{ folder: "", files: [...loose, ...direct] }] };
  const captures = stacksIn(folders);
  const [first] = captures;
  if (first === undefined) return fewIn(folders, place);
  if (captures.length > 1)
    return { captures, told: { kind: "several", count: captures.length, place, taken: first.folder } };
  if (tops.includes(first.folder)) return { captures };
  return { captures, told: { kind: "nested", folder: first.folder } };
}

function byFolder(placed: readonly Placed[]): Map<string, File[]> {
  const folders = new Map<string, File[]>();
  for (const { folder, file } of placed) {
    const files = folders.get(folder);
    if (files) files.push(file);
    else folders.set(folder, [file]);
  }
  return folders;
}

/** The folders that hold a stack; not those within such a folder, which are results or leftovers. */
function stacksIn(folders: ReadonlyMap<string, File[]>): Capture[] {
  const stacks = [...folders]
    .filter(([, files]) => files.filter(mayBePhotograph).length >= FEWEST)
    .map(([folder, files]) => ({ folder, files }))
    .sort((a, b) => a.folder.localeCompare(b.folder, "en", { numeric: true }));
  return stacks.filter(({ folder }) => !stacks.some((other) => folder.startsWith(`${other.folder}/`)));
}

/** No folder holds three photographs: an archive, one photograph in each folder, or nothing. */
function fewIn(folders: ReadonlyMap<string, File[]>, place: Place): Found {
  const filled = [...folders].filter(([, files]) => files.some(mayBePhotograph));
  const [only] = filled;
  if (filled.length >= FEWEST) {
    // One lamp in each folder: the names alone may be the same in all of them.
    const files = filled.flatMap(([folder, files]) =>
      files.map((file) => renamed(file, `${folder}/${file.name}`)),
    );
    return {
      captures: [{ folder: place.names.join(", "), files }],
      told: { kind: "one-in-each", folders: filled.length },
    };
  }
  if (only) {
    const [folder, files] = only;
    return { captures: [{ folder, files }] };
  }
  const others = [...folders.values()].flat().length;
  return { captures: [], told: { kind: "no-photographs", place, others } };
}

function renamed(file: File, name: string): File {
  return new File([file], name, { type: file.type, lastModified: file.lastModified });
}
