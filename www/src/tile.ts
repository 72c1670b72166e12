import type { ColorMode } from "normalight";
import { make } from "./dom.js";
import { texts } from "./texts/texts.js";

/** One file of the stack and its tile. */
export interface Entry {
  readonly file: File;
  readonly tile: HTMLLIElement;
  readonly picture: HTMLCanvasElement;
  /** Colour mode the thumbnail was made with; none yet when missing. */
  shown?: ColorMode;
  problem?: unknown;
}

/** A file with a tile that has no picture yet. @param remove is done when its button is pressed */
export function entryOf(file: File, remove: () => void): Entry {
  const picture = make("canvas");
  const button = make("button", "remove", "×");
  button.type = "button";
  button.title = texts.stack.remove(file.name);
  button.setAttribute("aria-label", button.title);
  button.tabIndex = -1;
  button.addEventListener("click", remove);
  const room = make("span", "room", texts.stack.roomLight);
  const tile = make("li", "", picture, make("span", "name", file.name), room, button);
  tile.title = file.name;
  return { file, tile, picture };
}

/** A mark on a tile that says what is doubtful about its file. */
export function flag(words: string): HTMLElement {
  const mark = make("span", "flag", "!");
  mark.setAttribute("role", "img");
  mark.setAttribute("aria-label", words);
  mark.title = words;
  return mark;
}
