/** What to call a stack of files: its folder or archive, or the first and last of its names. */
export function nameOf(files: readonly Pick<File, "name" | "webkitRelativePath">[]): string {
  const [first] = files;
  const last = files.at(-1);
  if (!first || !last) return "";
  const folder = first.webkitRelativePath.split("/").slice(0, -1).at(-1);
  if (folder) return folder;
  if (files.length === 1) return first.name;
  const [low, high] = [first.name, last.name].sort((a, b) => a.localeCompare(b, "en", { numeric: true }));
  return `${low} … ${high}`;
}

/** Whether two lists hold the same files, however they came here. */
export function sameFiles(some: readonly File[], others: readonly File[]): boolean {
  const key = ({ name, size, lastModified }: File) => `${name}/${size}/${lastModified}`;
  const keys = new Set(others.map(key));
  return some.length === others.length && some.every((file) => keys.has(key(file)));
}
