import type { Estimate, EstimateOptions, InputPlan, Progress } from "normalight";
import { croppedMask } from "./crop/mask.js";
import type { Engine } from "./engine.js";
import { shrunk } from "./large/shrink.js";
import { type Taken, takenWords } from "./large/taken.js";
import { en } from "./texts/en/index.js";
import { texts } from "./texts/texts.js";

/** What a run is made of. */
export interface Job {
  readonly files: readonly File[];
  /** Those of them that show the object. */
  readonly pictures: ReadonlySet<File>;
  /** The mask of the whole frame, where that is a file. */
  readonly mask: File | undefined;
  readonly options: EstimateOptions;
  readonly taken: Taken;
}

/** What a run gave. */
export interface Done {
  readonly estimate: Estimate;
  /** The files as the estimator got them: photographs may have been cropped and made smaller. */
  readonly used: readonly File[];
  /** How the photographs were taken, in words; empty for as they are. */
  readonly size: string;
  readonly taken: Taken;
}

/** Who follows a run. */
export interface Follow {
  readonly signal: AbortSignal;
  /** Says in words what is done before the estimate. */
  prepare(words: string): void;
  plan(plan: InputPlan, words: readonly string[]): void;
  progress(progress: Progress): void;
}

/** Prepares the photographs, and estimates. */
export async function doJob(engine: Engine, job: Job, follow: Follow): Promise<Done> {
  const { files, pictures, taken } = job;
  const { signal } = follow;
  const { color = "auto" } = job.options;
  const words = taken.crop ? texts.large.cropping : texts.large.shrinking;
  const used = await shrunk(files, pictures, taken, color === "linear", signal, (done, of) =>
    follow.prepare(words(done + 1, of)),
  );
  const { crop } = taken;
  let mask: File | undefined;
  if (crop && job.mask) {
    follow.prepare(texts.large.croppingMask);
    mask = await croppedMask(engine, files, job.mask, color, { ...taken, crop }, signal);
  }
  signal.throwIfAborted();
  const options: EstimateOptions = {
    ...job.options,
    ...(mask ? { mask } : {}),
    signal,
    onProgress: (progress) => follow.progress(progress),
    onPlan: (plan, words) => follow.plan(plan, words),
  };
  const estimate = await engine.with((normalight) => normalight.estimate(used, options));
  return { estimate: said(estimate, taken), used, size: takenWords(taken), taken };
}

/** An estimate that says how photographs were taken: beside the estimator's words and in its report, so in English. */
function said(estimate: Estimate, taken: Taken): Estimate {
  const size = takenWords(taken, en);
  if (size === "") return estimate;
  const { crop } = taken;
  const text = new TextEncoder();
  const files = estimate.files.map((file) => {
    if (file.name !== "report.json") return file;
    const report = {
      ...JSON.parse(new TextDecoder().decode(file.bytes)),
      photographs_taken: size,
      ...(crop ? { photographs_crop: crop } : {}),
    };
    return { ...file, bytes: text.encode(`${JSON.stringify(report, null, 2)}\n`) };
  });
  return { ...estimate, files, planWords: [en.large.planLine(size), ...estimate.planWords] };
}

/** Seconds of all stages. */
export function total({ seconds }: Pick<Estimate, "seconds">): number {
  return seconds.reduce((sum, stage) => sum + stage.seconds, 0);
}
