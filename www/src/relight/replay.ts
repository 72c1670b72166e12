import type { Light } from "normalight";
import { byId, make, say, sayError } from "../dom.js";
import { texts } from "../texts/texts.js";
import type { Distrust } from "./distrust.js";
import type { Relighting } from "./relighting.js";
import { EXPOSURE, type Lamp } from "./shading.js";

/** Milliseconds for which a photograph is shown. */
const PACE = 900;

/** The photographs one after the other, each beside the object under the same light. */
export class Replay {
  readonly #select = byId<HTMLSelectElement>("replay");
  readonly #play = byId<HTMLButtonElement>("replay-play");
  readonly #words = byId("replay-words");
  #lights: readonly Light[] = [];
  #distrust: Distrust | undefined;
  /** One's own lamps, while those of the photographs shine. */
  #own: readonly Lamp[] | undefined;
  #playing = false;

  /** @param shown hears which photograph is beside the object now, if any */
  constructor(
    private readonly relighting: Relighting,
    private readonly shown: (index: number | undefined) => void,
  ) {
    this.#select.addEventListener("change", () => {
      this.#stop();
      void this.#show();
    });
    this.#play.addEventListener("click", () => {
      if (this.#playing) this.#stop();
      else void this.#run();
    });
    byId("replay-next").addEventListener("click", () => void this.#step(1));
    byId("replay-previous").addEventListener("click", () => void this.#step(-1));
  }

  /** The chosen photograph; the first where none is. */
  get index(): number {
    return Number(this.#select.value || 0);
  }

  /** Takes another result. */
  show(lights: readonly Light[], distrust: Distrust): void {
    this.#stop();
    this.#lights = lights;
    this.#distrust = distrust;
    this.#own = undefined;
    const options = lights.map(({ file }, index) => option(String(index), file));
    this.#select.replaceChildren(option("", texts.relight.noPhotograph), ...options);
    say(this.#words, "");
  }

  async #run(): Promise<void> {
    this.#playing = true;
    this.#play.textContent = texts.relight.stop;
    while (this.#playing) {
      await this.#next(1);
      await new Promise((resolve) => setTimeout(resolve, PACE));
      if (byId("result").hidden || document.hidden) this.#stop();
    }
  }

  #stop(): void {
    this.#playing = false;
    this.#play.textContent = texts.relight.play;
  }

  async #step(by: number): Promise<void> {
    this.#stop();
    await this.#next(by);
  }

  async #next(by: number): Promise<void> {
    const { length } = this.#lights;
    const now = this.#select.value === "" ? (by > 0 ? -1 : length) : Number(this.#select.value);
    this.#select.value = String((now + by + length) % length);
    await this.#show();
  }

  /** The lamp of the chosen photograph shines, as bright as it was there. */
  async #show(): Promise<void> {
    const { value } = this.#select;
    const distrust = this.#distrust;
    if (value === "") {
      if (this.#own) this.relighting.lamps.set(this.#own);
      this.#own = undefined;
      say(this.#words, "");
      this.shown(undefined);
      return;
    }
    const index = Number(value);
    this.#own ??= this.relighting.lamps.all;
    const { x, y } = this.#lights[index] ?? { x: 0, y: 0 };
    try {
      const compared = await distrust?.of(index);
      // Another one was chosen meanwhile, or another result came.
      if (!compared || this.#select.value !== value || this.#distrust !== distrust) return;
      this.relighting.lamps.set([{ x, y, brightness: compared.brightness / EXPOSURE }]);
      say(this.#words, texts.relight.difference(compared.mean));
      this.shown(index);
    } catch (error) {
      if (this.#distrust !== distrust) return;
      this.#stop();
      sayError(this.#words, error, texts.relight.failed);
    }
  }
}

function option(value: string, words: string): HTMLOptionElement {
  const made = make("option", "", words);
  made.value = value;
  return made;
}
