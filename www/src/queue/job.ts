import type { Capture } from "../captures.js";
import type { Engine } from "../engine.js";
import type { Job } from "../job.js";
import type { General, SizeChoice } from "../large/size.js";
import type { Settings } from "../settings.js";

/** What a job on photographs that are not on the bench is made of. */
export interface Makings {
  readonly engine: Engine;
  readonly settings: Settings;
  readonly size: SizeChoice;
}

/** The job of a capture that nobody has looked at, with the settings that do not belong to single photographs. */
export async function jobOf(
  { engine, settings, size }: Makings,
  capture: Capture,
  general: General,
): Promise<Job> {
  const unpacked = await engine.with((normalight) => normalight.unpack(capture.files));
  const files = unpacked?.files ?? [...capture.files];
  const { images, leftOut, mask } = await engine.with((normalight) => normalight.plan(files));
  const photographs = images.flatMap((index) => files[index] ?? []);
  const lacking = settings.lacking(photographs.length);
  if (lacking) throw new Error(lacking);
  const lampless = leftOut.filter(({ reason }) => reason.kind === "ambient");
  const named = lampless.flatMap(({ file }) => files.find(({ name }) => name === file) ?? []);
  const options = settings.optionsOfOthers(photographs);
  return {
    files,
    pictures: new Set([...photographs, ...named]),
    mask: options.mask === "auto" && mask !== undefined ? files[mask] : undefined,
    options,
    taken: await size.takenOf(photographs, general),
  };
}
