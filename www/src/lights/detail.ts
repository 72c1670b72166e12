import { context, make } from "../dom.js";
import { texts } from "../texts/texts.js";
import { directed, type HandLight, inWords } from "./light.js";

const FIELDS = ["x", "y", "z", "intensity"] as const;

/** The light that is chosen: its photograph, its numbers to type, and whether it is used. */
export class LightDetail {
  readonly element = make("div", "light-detail");
  readonly #picture = make("canvas");
  readonly #name = make("b");
  readonly #words = make("span");
  readonly #used = make("input");
  readonly #inputs = new Map<(typeof FIELDS)[number], HTMLInputElement>();
  #light: HandLight | undefined;

  constructor(heard: { change(light: HandLight): void; use(used: boolean): void }) {
    this.#used.type = "checkbox";
    this.#used.name = "light-used";
    this.#used.addEventListener("change", () => heard.use(this.#used.checked));
    this.#picture.setAttribute("aria-hidden", "true");
    const numbers = make("div", "light-numbers");
    for (const name of FIELDS) {
      const input = make("input");
      Object.assign(input, { type: "number", step: "any", name: `light-${name}` });
      input.addEventListener("change", () => {
        const light = this.#typed();
        if (light) heard.change(light);
        else this.#tell();
      });
      this.#inputs.set(name, input);
      numbers.append(make("label", "", texts.lights.fields[name], input));
    }
    const used = make("label", "switch", this.#used, texts.lights.use);
    this.element.append(
      this.#picture,
      make("div", "", make("p", "", this.#name, this.#words), used),
      numbers,
    );
  }

  show(light: HandLight, used: boolean, picture: HTMLCanvasElement | undefined): void {
    this.#light = light;
    this.#used.checked = used;
    this.#name.textContent = light.file;
    this.#words.textContent = texts.lights.detail(inWords(light), light.confidence);
    this.draw(picture);
    this.#tell();
  }

  /** The photograph, as soon as there is one to be seen. */
  draw(picture: HTMLCanvasElement | undefined): void {
    this.#picture.hidden = picture === undefined || picture.width === 0;
    if (picture && picture.width > 0) {
      this.#picture.width = picture.width;
      this.#picture.height = picture.height;
      context(this.#picture).drawImage(picture, 0, 0);
    }
  }

  #tell(): void {
    for (const [name, input] of this.#inputs) input.value = this.#light?.[name].toFixed(3) ?? "";
  }

  /** The light of the typed numbers; nothing when they make none. */
  #typed(): HandLight | undefined {
    const value = (name: (typeof FIELDS)[number]) => this.#inputs.get(name)?.valueAsNumber ?? Number.NaN;
    const intensity = value("intensity");
    if (!this.#light || !(intensity > 0)) return undefined;
    return directed({ ...this.#light, intensity }, value("x"), value("y"), value("z"));
  }
}
