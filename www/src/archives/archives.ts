import { ask } from "../ask.js";
import { type Found, isOther } from "../captures.js";
import { texts } from "../texts/texts.js";
import type { ArchiveProblem, FromArchives } from "./worker.js";

const ZIP = /\.zip$/i;

/** Whether all that may be photographs among some files are archives that can be looked into here. */
export function areArchives(files: readonly File[]): boolean {
  const all = files.filter((file) => !isOther(file));
  return all.length > 0 && all.every(({ name }) => ZIP.test(name));
}

/**
 * The captures in zip archives, where there are several; the estimator takes archives of one capture by itself, and other
 * kinds of them.
 */
export async function capturesOf(files: readonly File[]): Promise<Found | undefined> {
  const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  try {
    const archives = files.filter(({ name }) => ZIP.test(name));
    const answer = await ask<FromArchives>(worker, archives, texts.folders.archiveUnread);
    if ("problem" in answer) throw new Error(wordsFor(answer.problem));
    return answer.found;
  } finally {
    worker.terminate();
  }
}

function wordsFor(problem: ArchiveProblem): string {
  if (problem.kind === "broken") return problem.message;
  return texts.folders.archiveTooLarge(problem.place, problem.gigabytes);
}
