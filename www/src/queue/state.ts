import type { Reason } from "../dom.js";
import type { Outcome } from "../result.js";

/** How far a stack of a queue is, and what there is to say of it. */
export type State =
  | { readonly kind: "waiting" | "now" | "cancelled" | "interrupted" }
  | { readonly kind: "failed"; readonly reason: Reason }
  | { readonly kind: "done"; readonly facts: Facts };

/** What the list says of a result. */
export interface Facts extends Pick<Outcome, "taken"> {
  readonly photographs: number;
  readonly width: number;
  readonly height: number;
  readonly seconds: number;
}

/** A result without what is large: that lies in the browser. */
export type Light = Omit<Outcome, "estimate">;

/** Until when the results of a queue are kept, and why not longer. */
export type Term = "page" | "memory" | "reload" | "no-room";

/** A queue as it is kept for a reload. */
export interface KeptQueue {
  /** Under which name its results lie in the browser. */
  readonly name: string;
  readonly stacks: readonly {
    readonly folder: string;
    readonly state: State;
    /** Of one that is done. */
    readonly result: Light | undefined;
  }[];
  /** The one whose result is shown. */
  readonly shown: number | undefined;
}
