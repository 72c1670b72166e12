import { make } from "../dom.js";
import { Roving } from "../roving.js";
import { fixed, signed } from "../texts/numbers.js";
import { texts } from "../texts/texts.js";
import type { HandLight } from "./light.js";

/** All lights as rows; one of them is chosen. */
export class LightTable {
  readonly #body: HTMLElement;
  readonly #roving: Roving;
  readonly #heard: {
    select(index: number): void;
    point(index: number): void;
    use(index: number, used: boolean): void;
  };

  constructor(
    body: HTMLElement,
    heard: {
      select(index: number): void;
      point(index: number): void;
      use(index: number, used: boolean): void;
    },
  ) {
    this.#body = body;
    this.#heard = heard;
    this.#roving = new Roving(body, ".light-name");
  }

  show(lights: readonly HandLight[], left: ReadonlySet<number>, selected: number): void {
    const most = Math.max(...lights.map(({ intensity }) => intensity), 1e-9);
    const focused = this.#body.contains(document.activeElement);
    const rows = lights.map((light, index) =>
      this.#row(light, index, most, !left.has(index), index === selected),
    );
    this.#body.replaceChildren(...rows);
    this.#roving.update();
    if (focused) rows[selected]?.querySelector<HTMLElement>(".light-name")?.focus({ preventScroll: true });
  }

  #row(light: HandLight, index: number, most: number, used: boolean, chosen: boolean): HTMLTableRowElement {
    const { file, x, y, z, intensity, confidence } = light;
    const name = make("button", "light-name", file);
    name.type = "button";
    name.setAttribute("aria-pressed", String(chosen));
    name.addEventListener("click", () => this.#heard.select(index));
    name.addEventListener("keydown", ({ key }) => {
      if (key === "Delete") this.#heard.use(index, !used);
    });
    const row = make(
      "tr",
      used ? "" : "left-out",
      make("th", "", name),
      ...[x, y, z].map((value) => make("td", "number", signed(fixed(value, 3)))),
      make("td", "", bar(intensity / most, fixed(intensity, 2))),
      make("td", "", used ? bar(confidence, texts.lights.percent(confidence)) : texts.lights.leftOut),
    );
    row.addEventListener("pointerenter", () => this.#heard.point(index));
    return row;
  }
}

function bar(share: number, words: string): HTMLElement {
  const whole = make("span", "bar", words);
  whole.style.setProperty("--share", `${Math.round(100 * Math.min(Math.max(share, 0), 1))}%`);
  return whole;
}
