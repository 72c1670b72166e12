import type { Capture, Found } from "./captures.js";
import { byId, make, say } from "./dom.js";

/** Takes the stack that was found in a folder, and offers the others that lie beside it. */
export class FolderChoice {
  readonly #take: (files: File[]) => void;
  readonly #words = byId("folder-words");
  readonly #others = byId("folder-others");

  constructor(take: (files: File[]) => void) {
    this.#take = take;
  }

  found({ captures, words }: Found): void {
    const [first] = captures;
    // Nothing was found: what is on the bench stays there.
    if (first) this.#take([...first.files]);
    say(this.#words, words);
    this.#offer(captures, first);
  }

  /** Other files are taken: what was said of a folder is out of date. */
  forget(): void {
    say(this.#words, "");
    this.#offer([], undefined);
  }

  #offer(captures: readonly Capture[], taken: Capture | undefined): void {
    this.#others.hidden = captures.length < 2;
    const buttons = (captures.length < 2 ? [] : captures).map((capture) => {
      const { folder, files } = capture;
      const button = make("button", "quiet", `${folder} (${files.length} files)`);
      button.type = "button";
      button.setAttribute("aria-pressed", String(capture === taken));
      button.addEventListener("click", () => {
        this.#take([...files]);
        say(this.#words, `Taken: ${folder}.`);
        this.#offer(captures, capture);
        this.#others.querySelector<HTMLElement>('[aria-pressed="true"]')?.focus();
      });
      return button;
    });
    this.#others.replaceChildren(...buttons);
  }
}
