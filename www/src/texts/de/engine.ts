import type { engine as en } from "../en/engine.js";

export const engine: typeof en = {
  starting: "Startet",
  loading: "Lädt",
  loadingPercent: (percent) => `Lädt ${percent} %`,
  ready: { gpu: "Bereit auf der GPU", cpu: "Bereit auf der CPU" },
  notices: {
    "There is no WebGPU here, so the processor computes.":
      "Hier gibt es kein WebGPU, daher rechnet der Prozessor.",
    "WebGPU finds no graphics adapter here, so the processor computes.":
      "WebGPU findet hier keine Grafikkarte, daher rechnet der Prozessor.",
  },
};
