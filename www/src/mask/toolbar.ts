import { make } from "../dom.js";
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

/** The tools, their keys, and what they are for. */
export const TOOLS: Record<Tool, { words: string; key: string; title: string }> = {
  brush: { words: "Brush", key: "b", title: "Paints what belongs to the object; the right button erases" },
  eraser: { words: "Eraser", key: "e", title: "Paints what does not belong to the object" },
  polygon: {
    words: "Polygon",
    key: "p",
    title: "Adds what lies within corners; Enter or a double click closes",
  },
  cut: { words: "Cut out", key: "c", title: "Removes what lies within corners" },
  move: { words: "Move", key: "h", title: "Moves the photograph; the middle button does so with every tool" },
};

/** Which tool is in the hand. */
export class ToolChoice {
  readonly element = make("div", "choice mask-tools");
  readonly #chosen: (tool: Tool) => void;

  constructor(chosen: (tool: Tool) => void) {
    this.#chosen = chosen;
    this.element.setAttribute("role", "radiogroup");
    this.element.setAttribute("aria-label", "Tool");
    for (const [tool, { words, key, title }] of Object.entries(TOOLS)) {
      const radio = make("input");
      Object.assign(radio, { type: "radio", name: "mask-tool", value: tool, checked: tool === "brush" });
      radio.addEventListener("change", () => chosen(tool as Tool));
      const label = make("label", "", radio, make("span", "", words));
      label.title = `${title} (key ${key.toUpperCase()})`;
      this.element.append(label);
    }
  }

  choose(tool: Tool): void {
    const radio = this.element.querySelector<HTMLInputElement>(`[value="${tool}"]`);
    if (radio) radio.checked = true;
    this.#chosen(tool);
  }
}
