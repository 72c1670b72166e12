import { type Progress, STAGES, type Stage } from "normalight";
import { byId, make } from "./dom.js";
import { texts } from "./texts/texts.js";
import { timeLeft } from "./time_left.js";

/** The bar of a run and its stages. */
export class ProgressView {
  readonly #whole = byId("progress");
  readonly #bar = byId<HTMLProgressElement>("progress-bar");
  readonly #words = byId("progress-words");
  readonly #items = new Map<Stage, HTMLLIElement>();
  /** Not read aloud: it changes all the time. */
  readonly #left = byId("progress-left");
  #current: Stage | undefined;
  #began = 0;
  #told = 0;
  /** Which of several runs it is, in words. */
  #which = "";

  constructor() {
    for (const stage of STAGES) this.#items.set(stage, make("li", "", texts.run.stages[stage]));
    byId("stages").append(...this.#items.values());
  }

  /** @param which of several runs begins, in words */
  start(which = ""): void {
    this.#which = which;
    this.#current = undefined;
    this.prepare(texts.run.waiting);
    this.#left.textContent = "";
    this.#began = 0;
    this.#bar.removeAttribute("value");
    for (const item of this.#items.values()) delete item.dataset.state;
    this.#whole.hidden = false;
  }

  /** Says what is done before the run. */
  prepare(words: string): void {
    this.#words.textContent = this.#which ? texts.run.inOneOf(this.#which, words) : words;
  }

  show({ stage, fraction, stageFraction }: Progress): void {
    this.#bar.value = fraction;
    this.#tellTimeLeft(fraction);
    this.#items.get(stage)?.style.setProperty("--done", `${100 * stageFraction}%`);
    if (stage === this.#current) return;
    this.#current = stage;
    // Read aloud, so only when there is something new to say.
    this.prepare(texts.run.estimating(stage));
    let state = "done";
    for (const [name, item] of this.#items) {
      if (name === stage) state = "now";
      item.dataset.state = state;
      if (name === stage) state = "";
    }
  }

  /** Once a second: numbers that change faster cannot be read. */
  #tellTimeLeft(fraction: number): void {
    const now = performance.now();
    // From the first word on: loading the module is no part of the run.
    if (this.#began === 0) this.#began = now;
    if (now - this.#told < 1000) return;
    this.#told = now;
    this.#left.textContent = timeLeft((now - this.#began) / 1000, fraction);
  }

  end(): void {
    this.#whole.hidden = true;
  }
}
