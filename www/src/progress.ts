import { type Progress, STAGES, type Stage } from "normalight";
import { byId, make } from "./dom.js";

/** The bar of a run and its stages. */
export class ProgressView {
  readonly #whole = byId("progress");
  readonly #bar = byId<HTMLProgressElement>("progress-bar");
  readonly #words = byId("progress-words");
  readonly #items = new Map<Stage, HTMLLIElement>();
  #current: Stage | undefined;

  constructor() {
    for (const stage of STAGES) this.#items.set(stage, make("li", "", stage));
    byId("stages").append(...this.#items.values());
  }

  start(): void {
    this.#current = undefined;
    this.#words.textContent = "Waiting for the estimator";
    this.#bar.removeAttribute("value");
    for (const item of this.#items.values()) delete item.dataset.state;
    this.#whole.hidden = false;
  }

  show({ stage, fraction, stageFraction }: Progress): void {
    this.#bar.value = fraction;
    this.#items.get(stage)?.style.setProperty("--done", `${100 * stageFraction}%`);
    if (stage === this.#current) return;
    this.#current = stage;
    // Read aloud, so only when there is something new to say.
    this.#words.textContent = `Estimating: ${stage}`;
    let state = "done";
    for (const [name, item] of this.#items) {
      if (name === stage) state = "now";
      item.dataset.state = state;
      if (name === stage) state = "";
    }
  }

  end(): void {
    this.#whole.hidden = true;
  }
}
