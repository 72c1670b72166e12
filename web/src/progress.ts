import { type Progress, type Quality, STAGES, type Stage } from "./types.js";

/** Time that the stages of a full run take where there is one view, roughly. */
const TIMES: Record<Stage, number> = {
  reading: 0.06,
  lights: 0.2,
  normals: 0.34,
  refit: 0.05,
  "final normals": 0.33,
  albedo: 0.02,
};

/** Views that the lights, the normals to which they are refitted and the last normals are averaged over. */
const VIEWS: Record<Quality, { lights: number; first: number; last: number }> = {
  fast: { lights: 1, first: 1, last: 1 },
  default: { lights: 2, first: 1, last: 4 },
  best: { lights: 2, first: 8, last: 8 },
};

/** Makes one progress of the stages' own. */
export class Aggregate {
  readonly #shares: Record<Stage, number>;
  #fraction = 0;

  /** For a run of this quality; `refit` when normals are estimated twice. */
  constructor(quality: Quality, refit: boolean) {
    const { lights, first, last } = VIEWS[quality];
    const times = { ...TIMES };
    times.lights *= lights;
    times.normals *= refit ? first : last;
    times.refit *= Number(refit);
    times["final normals"] *= refit ? last : 0;
    const whole = STAGES.reduce((sum, stage) => sum + times[stage], 0);
    for (const stage of STAGES) times[stage] /= whole;
    this.#shares = times;
  }

  /** The progress of the whole run when a stage is done by `stageFraction`. */
  at(stage: Stage, stageFraction: number): Progress {
    const before = STAGES.slice(0, STAGES.indexOf(stage)).reduce((sum, name) => sum + this.#shares[name], 0);
    const share = Math.min(Math.max(stageFraction, 0), 1);
    this.#fraction = Math.max(this.#fraction, Math.min(before + this.#shares[stage] * share, 1));
    return { stage, stageFraction: share, fraction: this.#fraction };
  }
}
