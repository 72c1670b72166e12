import type { Stage } from "normalight";
import type { run as en } from "../en/run.js";
import { fixed } from "../numbers.js";

const stages: Record<Stage, string> = {
  reading: "Einlesen",
  lights: "Lichter",
  normals: "Normalen",
  refit: "Anpassen",
  "final normals": "endgültige Normalen",
  albedo: "Albedo",
};

export const run: typeof en = {
  title: "Lauf",
  start: "Lichter und Normalen schätzen",
  cancel: "Abbrechen",
  progress: "Fortschritt des Laufs",
  notices: "Was an diesen Fotos zweifelhaft ist",
  dropIgnored:
    "Gerade wird geschätzt: Was hineingezogen wurde, bleibt unbeachtet. Brechen Sie zuerst ab, und versuchen Sie es dann noch einmal.",
  underWay: "Gerade wird geschätzt: Warten Sie das Ende ab, oder brechen Sie zuerst ab.",
  done: (seconds) => `Fertig in ${fixed(seconds, 1)} s.`,
  cancelled: "Abgebrochen. Die Fotos sind noch da.",
  stages,
  waiting: "Warten auf den Schätzer",
  estimating: (stage) => `Schätzen: ${stages[stage]}`,
  inOneOf: (which, words) => `${which}: ${words}`,
  left: {
    seconds: (seconds) => `noch etwa ${seconds} s`,
    minutes: (minutes) => `noch etwa ${minutes} min`,
    hours: (hours) => `noch etwa ${hours} h`,
    few: "noch einige Sekunden",
  },
};
