import { type Progress, STAGES, type Stage } from "./types.js";

/** Shares of the time that the stages of a full run take, roughly; they sum to 1. */
const SHARES: Record<Stage, number> = {
  reading: 0.06,
  lights: 0.18,
  normals: 0.3,
  refit: 0.03,
  "final lights": 0.12,
  "final normals": 0.29,
  albedo: 0.02,
};

/** Makes one progress of the stages' own. */
export class Aggregate {
  #fraction = 0;

  /** The progress of the whole run when a stage is done by `stageFraction`. */
  at(stage: Stage, stageFraction: number): Progress {
    const before = STAGES.slice(0, STAGES.indexOf(stage)).reduce((sum, name) => sum + SHARES[name], 0);
    const share = Math.min(Math.max(stageFraction, 0), 1);
    this.#fraction = Math.max(this.#fraction, Math.min(before + SHARES[stage] * share, 1));
    return { stage, stageFraction: share, fraction: this.#fraction };
  }
}
