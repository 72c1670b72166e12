import type { InputPlan, Plan } from "normalight";
import { type Line, lineOf } from "../lines.js";

/** What was decided about files: in English as the estimator says it. */
export const plan = {
  ofFiles: ({ words }: Plan): Line[] => words.map(lineOf),
  /** @param _taken how the page took the photographs, in words; empty for as they are */
  ofRun: (_plan: InputPlan, words: readonly string[], _taken: string): Line[] => words.map(lineOf),
};
