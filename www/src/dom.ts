import { type ErrorCode, NormalightError } from "normalight";
import { language } from "./texts/language.js";
import { type Line, lineOf } from "./texts/lines.js";
import { texts } from "./texts/texts.js";

/** An element of the page that is known to be there. */
export function byId<E extends HTMLElement = HTMLElement>(id: string): E {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`the page has no element #${id}`);
  return element as E;
}

/** A new element with a class and content. */
export function make<K extends keyof HTMLElementTagNameMap>(
  name: K,
  className = "",
  ...content: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  if (className) element.className = className;
  element.append(...content);
  return element;
}

/** The drawing context of a canvas. */
export function context(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const drawing = canvas.getContext("2d");
  if (drawing === null) throw new Error(texts.errors.noDrawing);
  return drawing;
}

/** Puts RGBA pixels on a canvas, which takes their size. */
export function paint(
  canvas: HTMLCanvasElement,
  width: number,
  height: number,
  rgba: Uint8Array<ArrayBuffer>,
): void {
  canvas.width = width;
  canvas.height = height;
  const pixels = new Uint8ClampedArray(rgba.buffer, rgba.byteOffset, rgba.byteLength);
  context(canvas).putImageData(new ImageData(pixels, width, height), 0, 0);
}

/** Changes the words of an element, where they are others: the same ones would be laid out again. */
export function write(element: HTMLElement, words: string): void {
  if (element.textContent !== words) element.textContent = words;
}

/** Shows words in an element, which is hidden while there are none. */
export function say(element: HTMLElement, words: string): void {
  element.hidden = words === "";
  element.textContent = words;
}

/** Words that the estimator or the browser wrote: they are English whatever the page speaks, and are to be read so. */
export function english(words: string): HTMLElement | string {
  if (language === "en") return words;
  const element = make("span", "", words);
  element.lang = "en";
  return element;
}

/** Stands for the reason where words are made around one. */
const REASON = "\0";

/** Why something went wrong, as it can be kept. */
export interface Reason {
  readonly words: string;
  /** Whether others than the page have written them. */
  readonly foreign: boolean;
  /** What kind of failure the estimator calls it. */
  readonly code: ErrorCode | undefined;
}

/** What an error says. */
export function reasonOf(error: unknown): Reason {
  const code = error instanceof NormalightError ? error.code : undefined;
  return { words: wordsOf(error), foreign: isForeign(error), code };
}

/** Shows what went wrong. @param around makes the words that the reason stands in */
export function sayError(element: HTMLElement, error: unknown, around?: (why: string) => string): void {
  sayReason(element, reasonOf(error), around);
}

/** Shows why something went wrong. @param around makes the words that the reason stands in */
export function sayReason(
  element: HTMLElement,
  { words, foreign, code }: Reason,
  around = (why: string) => why,
): void {
  if (!foreign) {
    say(element, around(words));
    return;
  }
  const kind = code && texts.errors.before?.[code];
  const [before = "", after = ""] = around(kind ? `${kind}: ${REASON}` : REASON).split(REASON);
  element.hidden = false;
  element.replaceChildren(before, english(words), after);
}

/** Whether others than the page have written what an error says. */
function isForeign(error: unknown): boolean {
  return [NormalightError, DOMException, TypeError, RangeError].some((kind) => error instanceof kind);
}

/** Shows lines in a list, which is hidden while there are none; what is doubtful stands out. */
export function sayLines(list: HTMLElement, lines: readonly (Line | string)[]): void {
  list.hidden = lines.length === 0;
  const items = lines.map((line) => (typeof line === "string" ? lineOf(line) : line));
  list.replaceChildren(
    ...items.map((line) => {
      const item = make("li", line.doubtful ? "doubtful" : "", line.words);
      if (line.english) item.append(": ", english(line.english));
      return item;
    }),
  );
}

/** What a failure says to people. */
export function wordsOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** The value of a group of radio buttons. */
export function chosen(form: HTMLFormElement, name: string): string {
  return String(new FormData(form).get(name));
}
