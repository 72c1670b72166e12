import { language } from "./language.js";

/** Formatters by their digits: making one takes longer than a number of a table that follows the pointer may. */
const formatters = new Map<number, Intl.NumberFormat>();

/** A number with so many digits after the point. */
export function fixed(value: number, digits: number): string {
  let formatter = formatters.get(digits);
  if (formatter === undefined) {
    formatter = new Intl.NumberFormat(language, {
      minimumFractionDigits: digits,
      maximumFractionDigits: digits,
      useGrouping: false,
    });
    formatters.set(digits, formatter);
  }
  // Zero has a sign of its own there, which nobody wants to read.
  return formatter.format(value === 0 ? 0 : value);
}

/** A number in few digits, with a minus as it is printed. */
export function short(value: number): string {
  const digits = Math.abs(value) >= 100 ? 0 : Math.abs(value) >= 10 ? 1 : 2;
  return signed(fixed(value, Number.isInteger(value) ? 0 : digits));
}

/** A written number with a minus as it is printed. */
export function signed(number: string): string {
  return number.replace("-", "−");
}

/** A whole number, with its thousands apart. */
export function whole(value: number): string {
  return value.toLocaleString(language);
}

/** A share of 0 to 1 as whole percent, without the sign. */
export function percent(share: number): string {
  return fixed(100 * share, 0);
}

/** A time of today, or a day and a time. */
export function since(time: number): string {
  const then = new Date(time);
  const clock = then.toLocaleTimeString(language, { hour: "2-digit", minute: "2-digit", hourCycle: "h23" });
  if (then.toDateString() === new Date().toDateString()) return clock;
  return `${then.toLocaleDateString(language, { day: "numeric", month: "long" })}, ${clock}`;
}
