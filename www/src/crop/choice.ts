import { byId, say, sayError } from "../dom.js";
import type { Engine } from "../engine.js";
import { aboutPhotograph } from "../large/about.js";
import type { Stack } from "../stack.js";
import { texts } from "../texts/texts.js";
import type { FramedCrop } from "./editor.js";
import type { Crop, Frame } from "./rectangle.js";

/** The part of the photographs on the bench that is taken. */
export class CropChoice {
  readonly #button = byId<HTMLButtonElement>("crop");
  readonly #remove = byId<HTMLButtonElement>("crop-remove");
  readonly #words = byId("crop-words");
  readonly #problem = byId("crop-problem");
  #kept: FramedCrop | undefined;

  /** @param changed hears of another part */
  constructor(
    private readonly engine: Engine,
    private readonly stack: Stack,
    private readonly changed: () => void,
  ) {
    this.#button.addEventListener("click", () => void this.#edit());
    this.#remove.addEventListener("click", () => {
      this.#take(undefined);
      // It would be lost with the button.
      this.#button.focus();
    });
  }

  /** None for the whole frame. */
  get crop(): Crop | undefined {
    return this.#kept?.crop;
  }

  /** The size of the photographs on which it was drawn. */
  get frame(): Frame | undefined {
    return this.#kept?.frame;
  }

  /** What is to be kept for a reload. */
  get kept(): FramedCrop | undefined {
    return this.#kept;
  }

  /** Sets it as it was kept. */
  restore(kept: FramedCrop | undefined): void {
    this.#take(kept);
  }

  /** Other photographs are on the bench. */
  forget(): void {
    say(this.#problem, "");
    if (this.#kept) this.#take(undefined);
  }

  async #edit(): Promise<void> {
    const [file] = this.stack.photographs;
    say(this.#problem, file ? "" : texts.crop.unknown);
    if (!file) return;
    this.#button.disabled = true;
    try {
      const { fixed } = await aboutPhotograph(file, this.engine);
      if (fixed) throw new Error(texts.crop.fixed(file.name, fixed));
      const { editCrop } = await import("./editor.js");
      const edited = await editCrop(file, this.crop);
      if (edited) this.#take(edited.crop && edited);
    } catch (error) {
      sayError(this.#problem, error);
    }
    this.#button.disabled = false;
    this.#button.focus();
  }

  #take(kept: FramedCrop | undefined): void {
    this.#kept = kept;
    const { crop, frame } = kept ?? {};
    say(this.#words, crop && frame ? texts.crop.taken(crop, frame) : "");
    this.#remove.hidden = crop === undefined;
    this.#button.textContent = crop ? texts.crop.change : texts.crop.begin;
    this.changed();
  }
}
