import type { Term } from "../../queue/state.js";
import { fixed } from "../numbers.js";

const done = (done: number, of: number, failed: number) =>
  `${done} of ${of} stacks done${failed > 0 ? `, ${failed} failed` : ""}`;

const TERMS: Readonly<Record<Term, string>> = {
  page: "Results are kept on this device until this page is closed.",
  memory: "This browser has no room for results, so they are in this page's memory until it is closed.",
  reload: "Results are kept on this device for a reload, with their photographs, until you forget them.",
  "no-room":
    "Results are kept on this device until this page is closed: this browser has no room for all their photographs.",
};

/** Several stacks, one after the other. */
export const queue = {
  states: {
    waiting: "waiting",
    now: "is estimated now",
    cancelled: "not estimated: cancelled",
    interrupted: "not estimated: the page was closed",
  },
  failed: (why: string) => `failed: ${why}`,
  /** @param how in which size and part the photographs were taken; empty for as they are */
  done: (photographs: number, width: number, height: number, how: string, seconds: number) =>
    `${photographs} photographs of ${width} × ${height} pixels${how && `, ${how}`}; ${fixed(seconds, 1)} s`,
  show: "Shows this result",
  /** Before what is said of the run. */
  stack: (number: number, of: number, name: string) => `Stack ${number} of ${of}, ${name}`,
  sofar: (finished: number, of: number, failed: number, term: Term) =>
    `${done(finished, of, failed)}. ${TERMS[term]}`,
  end: (finished: number, of: number, failed: number, seconds: number) => {
    const cancelled = finished + failed < of ? " Cancelled; what is finished is kept." : "";
    return `${done(finished, of, failed)} in ${fixed(seconds, 0)} s.${cancelled}`;
  },
  notKept: "This result is not kept.",
  deleted: "The browser has deleted this result.",
};
