import type { ErrorCode } from "normalight";

export const errors = {
  noDrawing: "this browser cannot draw",
  /** What comes before the estimator's own words about a failure, which are English: what kind of failure it is. */
  before: undefined as Readonly<Record<ErrorCode, string>> | undefined,
};
