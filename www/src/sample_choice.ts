import { byId, make, say, sayError } from "./dom.js";
import { fetchSample, listSamples, type Sample, thumbnailOf } from "./samples.js";
import { texts } from "./texts/texts.js";

/** The samples to choose from, and the fetching of the chosen one. */
export class SampleChoice {
  readonly #take: (files: File[], sample: Sample) => void;
  readonly #progress = byId("sample-progress");
  readonly #words = byId("sample-words");
  readonly #bar = byId<HTMLProgressElement>("sample-bar");
  readonly #problem = byId("sample-problem");
  readonly #buttons = new Map<Sample, HTMLButtonElement>();
  #fetching: AbortController | undefined;

  /** @param take gets the files of a sample that was chosen and has arrived */
  constructor(take: (files: File[], sample: Sample) => void) {
    this.#take = take;
    byId("sample-cancel").addEventListener("click", () => this.cancel());
    void this.#list();
  }

  /** Gives up the sample that is being fetched. */
  cancel(): void {
    this.#fetching?.abort();
  }

  /** Other files are taken: no sample is the chosen one any more. */
  leave(): void {
    this.cancel();
    this.#mark(undefined);
    say(this.#problem, "");
  }

  async #list(): Promise<void> {
    try {
      for (const sample of await listSamples()) this.#buttons.set(sample, this.#button(sample));
      byId("sample-list").replaceChildren(
        ...[...this.#buttons.values()].map((button) => make("li", "", button)),
      );
    } catch (error) {
      sayError(this.#problem, error);
    }
    byId("samples").hidden = false;
  }

  #button(sample: Sample): HTMLButtonElement {
    const picture = make("img");
    // Before the address: it decides when the picture is fetched.
    picture.loading = "lazy";
    picture.width = picture.height = 192;
    // The title beside it says what it shows.
    picture.alt = "";
    picture.dataset.color = sample.color;
    picture.src = thumbnailOf(sample);
    const words = make("span", "words", make("b", "", sample.title), make("span", "", sample.description));
    const button = make("button", "sample", picture, words);
    button.type = "button";
    button.title = sample.description;
    button.dataset.sample = sample.name;
    button.addEventListener("click", () => void this.#choose(sample, button));
    return button;
  }

  async #choose(sample: Sample, button: HTMLButtonElement): Promise<void> {
    this.cancel();
    const fetching = new AbortController();
    this.#fetching = fetching;
    say(this.#problem, "");
    this.#words.textContent = texts.samples.fetching(sample.title);
    this.#bar.value = 0;
    this.#progress.hidden = false;
    let files: File[] | undefined;
    try {
      files = await fetchSample(sample, fetching.signal, (fraction) => {
        if (this.#fetching === fetching) this.#bar.value = fraction;
      });
    } catch (error) {
      if (!fetching.signal.aborted) sayError(this.#problem, error);
    }
    // Another sample was chosen meanwhile: the rest is about that one.
    if (this.#fetching !== fetching) return;
    this.#fetching = undefined;
    // The focus would be lost with the button that it is on.
    if (this.#progress.contains(document.activeElement)) button.focus();
    this.#progress.hidden = true;
    // All may have arrived just before it was given up.
    if (!files || fetching.signal.aborted) return;
    this.#mark(sample);
    this.#take(files, sample);
  }

  #mark(chosen: Sample | undefined): void {
    for (const [sample, button] of this.#buttons) {
      if (sample === chosen) button.setAttribute("aria-current", "true");
      else button.removeAttribute("aria-current");
    }
  }
}
