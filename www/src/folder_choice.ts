import type { Capture, Found, Told } from "./captures.js";
import { byId, make, say } from "./dom.js";
import { texts } from "./texts/texts.js";

/** Takes the stack that was found in a folder, and offers the others that lie beside it, or to estimate all. */
export class FolderChoice {
  readonly #take: (files: File[]) => void;
  readonly #words = byId("folder-words");
  readonly #others = byId("folder-others");
  readonly #all = byId("folder-all");
  readonly #estimateAll = byId<HTMLButtonElement>("estimate-all");
  #captures: readonly Capture[] = [];
  /** The one that is on the bench. */
  #taken: Capture | undefined;

  /** @param estimateAll gets all captures, and the one that is on the bench */
  constructor(
    take: (files: File[]) => void,
    estimateAll: (captures: readonly Capture[], taken: Capture | undefined) => void,
  ) {
    this.#take = take;
    this.#estimateAll.addEventListener("click", () => estimateAll(this.#captures, this.#taken));
  }

  /** One of several captures was put on the bench. */
  taken(captures: readonly Capture[], capture: Capture): void {
    say(this.#words, texts.folders.taken(capture.folder));
    this.#offer(captures, capture);
  }

  /** Says what is done before it is known what was found. */
  wait(words: string): void {
    say(this.#words, words);
  }

  found({ captures, told }: Found): void {
    const [first] = captures;
    // Nothing was found: what is on the bench stays there.
    if (first) this.#take([...first.files]);
    say(this.#words, told ? wordsFor(told) : "");
    this.#offer(captures, first);
  }

  /** Other files are taken: what was said of a folder is out of date. */
  forget(): void {
    say(this.#words, "");
    this.#offer([], undefined);
  }

  #offer(captures: readonly Capture[], taken: Capture | undefined): void {
    [this.#captures, this.#taken] = [captures, taken];
    this.#others.hidden = captures.length < 2;
    this.#all.hidden = captures.length < 2;
    this.#estimateAll.textContent = texts.folders.estimateAllCount(captures.length);
    const buttons = (captures.length < 2 ? [] : captures).map((capture) => {
      const { folder, files } = capture;
      const button = make("button", "quiet", texts.folders.folder(folder, files.length));
      button.type = "button";
      button.setAttribute("aria-pressed", String(capture === taken));
      button.addEventListener("click", () => {
        this.#take([...files]);
        this.taken(captures, capture);
        this.#others.querySelector<HTMLElement>('[aria-pressed="true"]')?.focus();
      });
      return button;
    });
    this.#others.replaceChildren(...buttons);
  }
}

/** What was found, in words. */
function wordsFor(told: Told): string {
  const { folders } = texts;
  switch (told.kind) {
    case "several":
      return folders.several(told.count, told.place, told.taken);
    case "nested":
      return folders.nested(told.folder);
    case "one-in-each":
      return folders.oneInEach(told.folders);
    case "no-photographs":
      return told.others === 0 ? folders.empty(told.place) : folders.noPhotographs(told.place, told.others);
    case "empty-folder":
      return folders.emptyFolder;
  }
}
