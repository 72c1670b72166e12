import type { Stage } from "normalight";
import { fixed } from "../numbers.js";

const stages: Record<Stage, string> = {
  reading: "reading",
  lights: "lights",
  normals: "normals",
  refit: "refit",
  "final normals": "final normals",
  albedo: "albedo",
};

export const run = {
  title: "Run",
  start: "Estimate lights and normals",
  cancel: "Cancel",
  progress: "Progress of the run",
  notices: "What is doubtful about these photographs",
  dropIgnored: "A run is under way: what was dropped is ignored. Cancel the run first, then try again.",
  underWay: "A run is under way: wait for its end, or cancel it first.",
  done: (seconds: number) => `Done in ${fixed(seconds, 1)} s.`,
  cancelled: "Cancelled. The photographs are still here.",
  stages,
  waiting: "Waiting for the estimator",
  estimating: (stage: Stage) => `Estimating: ${stages[stage]}`,
  /** What is done in one of several runs. */
  inOneOf: (which: string, words: string) => `${which}: ${words}`,
  left: {
    seconds: (seconds: number) => `about ${seconds} s left`,
    minutes: (minutes: number) => `about ${minutes} min left`,
    hours: (hours: number) => `about ${hours} h left`,
    few: "a few seconds left",
  },
};
