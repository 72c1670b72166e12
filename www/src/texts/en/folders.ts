import type { Place } from "../../captures.js";

/** Where something was looked for. */
function named({ kind, names }: Place): string {
  if (kind === "folders")
    return names.length === 1 ? `the folder ${names[0]}` : `the ${names.length} folders`;
  return names.length === 1 ? `the archive ${names[0]}` : `the ${names.length} archives`;
}

function capital(words: string): string {
  return words.charAt(0).toUpperCase() + words.slice(1);
}

export const folders = {
  others: "Folders with photographs",
  estimateAll: "Estimate all",
  estimateAllCount: (count: number) => `Estimate all ${count}`,
  estimateAllWhat:
    "One after the other, with these settings. A mask or lights from a file count for the stack below alone, a crop for photographs of the same size.",
  folder: (name: string, files: number) => `${name} (${files} files)`,
  taken: (folder: string) => `Taken: ${folder}.`,
  several: (count: number, place: Place, taken: string) =>
    `${count} folders with photographs lie in ${named(place)}. Taken: ${taken}.`,
  nested: (folder: string) => `The photographs lie in ${folder}.`,
  oneInEach: (count: number) => `The photographs lie in ${count} folders.`,
  empty: (place: Place) => `${capital(named(place))} is empty. Nothing was taken.`,
  noPhotographs: (place: Place, others: number) =>
    `${capital(named(place))} holds no photographs, only ${others === 1 ? "one other file" : `${others} other files`}. Nothing was taken.`,
  emptyFolder: "The folder is empty. Nothing was taken.",
  lookingIntoArchive: "Looking into the archive.",
  archiveTooLarge: (place: Place, gigabytes: number) =>
    `What lies in ${named(place)} has more than ${gigabytes} GB: unpack it first.`,
  archiveUnread: (reason: string) => `The archive cannot be unpacked: ${reason}`,
};
