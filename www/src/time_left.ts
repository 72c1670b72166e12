import { texts } from "./texts/texts.js";

/** Seconds and share of a run before which its speed says nothing. */
const SOONEST = { seconds: 3, fraction: 0.03 };

/** How long a run will still take, in words; empty while nobody can know. */
export function timeLeft(seconds: number, fraction: number): string {
  if (seconds < SOONEST.seconds || fraction < SOONEST.fraction) return "";
  const left = (seconds * (1 - fraction)) / fraction;
  if (left < 5) return texts.run.left.few;
  // As exact as such a guess can be: steps of five seconds, then of a minute.
  if (left < 90) return texts.run.left.seconds(5 * Math.ceil(left / 5));
  const minutes = Math.round(left / 60);
  return minutes < 90 ? texts.run.left.minutes(minutes) : texts.run.left.hours(Math.round(left / 3600));
}
