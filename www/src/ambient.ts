import type { EstimateOptions } from "normalight";
import { byId, make, say } from "./dom.js";
import type { Stack } from "./stack.js";
import { texts } from "./texts/texts.js";

/** What the estimator is told about a photograph without lamp. */
export type AmbientSetting = NonNullable<EstimateOptions["ambient"]>;

/**
 * A photograph under a name by which the estimator knows that it was taken without the lamp. The bracket brings it before
 * others whose names say the same: the first counts.
 */
export function asAmbient(file: File): File {
  const [, folder = "", name = ""] = /^(.*\/)?([^/]*)$/.exec(file.name) ?? [];
  return new File([file], `${folder}(ambient) ${name}`, { type: file.type, lastModified: file.lastModified });
}

/** The choice of the photograph that shows the light of the room alone. */
export class AmbientChoice {
  readonly #select = byId<HTMLSelectElement>("ambient");
  readonly #group = make("optgroup");
  readonly #words = byId("ambient-words");
  /** Those that can be chosen. */
  #files: readonly File[] = [];

  constructor(private readonly stack: Stack) {
    this.#group.label = texts.ambient.thisOne;
    this.#select.addEventListener("change", () => {
      const index = Number(this.#select.value);
      stack.markAmbient(this.#files[index]);
      this.#tell();
    });
  }

  /** The setting of a run on the stack. */
  get setting(): AmbientSetting {
    return this.#select.value === "none" ? "none" : "auto";
  }

  /** There are other files, or it is known now what they are. */
  renew(): void {
    const { files, marked } = this.stack.lampless;
    const { value } = this.#select;
    this.#files = files;
    this.#group.replaceChildren(...files.map(({ name }, index) => new Option(name, String(index))));
    if (files.length > 0) this.#select.append(this.#group);
    else this.#group.remove();
    if (marked) this.#select.value = String(files.indexOf(marked));
    else this.#select.value = value === "auto" ? "auto" : "none";
    this.#tell();
  }

  #tell(): void {
    const { marked, named } = this.stack.lampless;
    say(this.#words, wordsOf(this.#select.value, marked, named));
  }
}

/** What a choice means for these photographs. */
function wordsOf(choice: string, marked: File | undefined, named: readonly File[]): string {
  const [first] = named;
  if (marked) return texts.ambient.marked(marked.name);
  if (choice === "auto") return first ? texts.ambient.found(first.name) : texts.ambient.perhaps;
  return first ? texts.ambient.leftOut(first.name) : "";
}
