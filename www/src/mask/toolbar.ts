import { make } from "../dom.js";
import { texts } from "../texts/texts.js";
import type { Tool } from "./stage.js";

/** A button with a name for scripts, words and what it does. */
export function button(name: string, words: string, title: string, press: () => void): HTMLButtonElement {
  const made = make("button", "", words);
  made.type = "button";
  made.dataset.do = name;
  made.title = title;
  made.addEventListener("click", press);
  return made;
}

/** Controls under a heading. */
export function group(words: string, ...content: Node[]): HTMLElement {
  const heading = make("h3", "", words);
  const whole = make("section", "mask-group", heading, ...content);
  whole.setAttribute("aria-label", words);
  return whole;
}

/** Controls side by side. */
export function row(...content: Node[]): HTMLElement {
  return make("div", "mask-row", ...content);
}

/** A slider with its words and its value in words. */
export class Slider {
  readonly element: HTMLElement;
  readonly #input = make("input");
  readonly #output = make("output");
  readonly #words: (value: number) => string;

  constructor(
    name: string,
    label: string,
    range: { min: number; max: number; step: number; value: number },
    words: (value: number) => string,
    moved: (value: number) => void,
  ) {
    this.#words = words;
    this.#input.type = "range";
    this.#input.name = name;
    for (const [key, value] of Object.entries(range)) this.#input.setAttribute(key, String(value));
    this.#input.addEventListener("input", () => {
      this.#tell();
      moved(this.value);
    });
    this.element = make("label", "mask-slider", make("span", "", label), this.#output, this.#input);
    this.#tell();
  }

  get value(): number {
    return this.#input.valueAsNumber;
  }

  set value(value: number) {
    this.#input.valueAsNumber = value;
    this.#tell();
  }

  #tell(): void {
    this.#output.textContent = this.#words(this.value);
    this.#input.setAttribute("aria-valuetext", this.#words(this.value));
  }
}

/** The tools and their keys. */
export const TOOLS: Readonly<Record<Tool, string>> = {
  brush: "b",
  eraser: "e",
  polygon: "p",
  cut: "c",
  move: "h",
};

/** Which tool is in the hand. */
export class ToolChoice {
  readonly element = make("div", "choice mask-tools");
  readonly #chosen: (tool: Tool) => void;

  constructor(chosen: (tool: Tool) => void) {
    this.#chosen = chosen;
    this.element.setAttribute("role", "radiogroup");
    this.element.setAttribute("aria-label", texts.mask.tool);
    for (const [tool, key] of Object.entries(TOOLS)) {
      const { words, title } = texts.mask.tools[tool as Tool];
      const radio = make("input");
      Object.assign(radio, { type: "radio", name: "mask-tool", value: tool, checked: tool === "brush" });
      radio.addEventListener("change", () => chosen(tool as Tool));
      const label = make("label", "", radio, make("span", "", words));
      label.title = texts.mask.withKey(title, key.toUpperCase());
      this.element.append(label);
    }
  }

  choose(tool: Tool): void {
    const radio = this.element.querySelector<HTMLInputElement>(`[value="${tool}"]`);
    if (radio) radio.checked = true;
    this.#chosen(tool);
  }
}
