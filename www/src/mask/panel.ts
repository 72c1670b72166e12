import { make } from "../dom.js";
import { texts } from "../texts/texts.js";
import { MOST_PIXELS } from "./operations.js";
import type { Operation } from "./protocol.js";
import type { Tool } from "./stage.js";
import { button, group, row, Slider, ToolChoice } from "./toolbar.js";

/** What the controls beside the photograph ask for. */
export interface PanelActions {
  tool(tool: Tool): void;
  radius(pixels: number): void;
  operate(operation: Operation): void;
  fill(inside: boolean): void;
  automatic(): void;
  load(file: File): void;
  show(photograph: number): void;
  lighten(lightened: boolean): void;
}

/** The controls beside the photograph. */
export class MaskPanel {
  readonly element = make("div", "mask-panel");
  readonly tools: ToolChoice;
  readonly #size: Slider;
  readonly #lighten = make("input");
  readonly #actions: PanelActions;

  /** @param largest of the brush's radii, in pixels */
  constructor(photographs: readonly string[], largest: number, actions: PanelActions) {
    this.#actions = actions;
    this.tools = new ToolChoice(actions.tool);
    // Equal steps of the slider are equal factors: small brushes need fine ones.
    const radius = (value: number) => Math.max(largest ** value, 0.5);
    this.#size = new Slider(
      "mask-size",
      texts.mask.size,
      { min: 0, max: 1, step: 0.005, value: 0.55 },
      (value) => texts.mask.diameter(Math.round(2 * radius(value))),
      (value) => actions.radius(radius(value)),
    );
    actions.radius(radius(this.#size.value));
    this.element.append(
      group(texts.mask.tool, this.tools.element, this.#size.element),
      this.#brightness(),
      this.#edge(),
      this.#whole(),
      this.#photograph(photographs),
    );
  }

  /** Makes the brush larger or smaller by a step. */
  resize(steps: number): void {
    this.#size.value += steps * 0.025;
    this.element.querySelector('[name="mask-size"]')?.dispatchEvent(new Event("input"));
  }

  set lightened(lightened: boolean) {
    this.#lighten.checked = lightened;
    this.#actions.lighten(lightened);
  }

  #brightness(): HTMLElement {
    const side = make("select");
    side.setAttribute("aria-label", texts.mask.side);
    side.append(new Option(texts.mask.brighter, "brighter"), new Option(texts.mask.darker, "darker"));
    const apply = () =>
      this.#actions.operate({ kind: "threshold", level: level.value, brighter: side.value === "brighter" });
    const level = new Slider(
      "mask-level",
      texts.mask.brightness,
      { min: 1, max: 255, step: 1, value: 32 },
      (value) => texts.mask.percent(Math.round((100 * value) / 255)),
      apply,
    );
    side.addEventListener("change", apply);
    const take = button("threshold", texts.mask.take, texts.mask.takeTitle, apply);
    return group(texts.mask.byBrightness, level.element, row(side, take));
  }

  #edge(): HTMLElement {
    const pixels = make("input");
    Object.assign(pixels, {
      type: "number",
      name: "mask-pixels",
      min: "1",
      max: String(MOST_PIXELS),
      value: "2",
    });
    pixels.setAttribute("aria-label", texts.mask.edgePixels);
    const by = (kind: "grow" | "shrink") => () => {
      const radius = Math.min(Math.max(Math.round(pixels.valueAsNumber) || 1, 1), MOST_PIXELS);
      pixels.value = String(radius);
      this.#actions.operate({ kind, radius });
    };
    return group(
      texts.mask.edge,
      row(
        make("label", "mask-pixels", pixels, texts.mask.px),
        button("grow", texts.mask.grow, texts.mask.growTitle, by("grow")),
        button("shrink", texts.mask.shrink, texts.mask.shrinkTitle, by("shrink")),
        button("holes", texts.mask.holes, texts.mask.holesTitle, () =>
          this.#actions.operate({ kind: "holes" }),
        ),
      ),
    );
  }

  #whole(): HTMLElement {
    const picker = make("input");
    picker.type = "file";
    picker.hidden = true;
    picker.setAttribute("aria-label", texts.mask.file);
    picker.addEventListener("change", () => {
      const [file] = picker.files ?? [];
      if (file) this.#actions.load(file);
      picker.value = "";
    });
    return group(
      texts.mask.whole,
      row(
        button("automatic", texts.mask.automatic, texts.mask.automaticTitle, () => this.#actions.automatic()),
        button("load", texts.mask.load, texts.mask.loadTitle, () => picker.click()),
        button("invert", texts.mask.invert, texts.mask.invertTitle, () =>
          this.#actions.operate({ kind: "invert" }),
        ),
        button("frame", texts.mask.frame, texts.mask.frameTitle, () => this.#actions.fill(true)),
        button("clear", texts.mask.clear, texts.mask.clearTitle, () => this.#actions.fill(false)),
        picker,
      ),
    );
  }

  #photograph(names: readonly string[]): HTMLElement {
    const choice = make("select");
    choice.setAttribute("aria-label", texts.mask.photographUnder);
    choice.append(...names.map((name, index) => new Option(name, String(index))));
    choice.addEventListener("change", () => this.#actions.show(Number(choice.value)));
    this.#lighten.type = "checkbox";
    this.#lighten.addEventListener("change", () => this.#actions.lighten(this.#lighten.checked));
    return group(
      texts.mask.photograph,
      row(choice, make("label", "switch", this.#lighten, texts.mask.lightened)),
    );
  }
}
