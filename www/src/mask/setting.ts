import type { EstimateOptions } from "normalight";
import { byId, say, sayError } from "../dom.js";
import type { Engine } from "../engine.js";
import type { Settings } from "../settings.js";
import type { Stack } from "../stack.js";
import { texts } from "../texts/texts.js";
import { INSIDE } from "./tiles.js";

/** Longer side in pixels of photographs that only the estimator decodes: as large as they are. */
const WHOLE = 65_535;

/** The button beside the mask's setting that opens the editor, and what becomes of its mask. */
export class MaskSetting {
  readonly #button = byId<HTMLButtonElement>("mask-edit");
  readonly #problem = byId("mask-problem");
  readonly #engine: Engine;
  readonly #stack: Stack;
  readonly #settings: Settings;

  constructor(engine: Engine, stack: Stack, settings: Settings) {
    this.#engine = engine;
    this.#stack = stack;
    this.#settings = settings;
    this.#button.addEventListener("click", () => void this.#edit());
  }

  async #edit(): Promise<void> {
    const { photographs } = this.#stack;
    say(this.#problem, photographs.length === 0 ? texts.mask.noPhotographs : "");
    if (photographs.length === 0) return;
    this.#button.disabled = true;
    try {
      // Not before it is needed: most masks are found without it.
      const { editMask } = await import("./editor.js");
      const mask = await editMask({
        photographs,
        begin: () => this.#begin(),
        automatic: () => this.#ask("auto"),
        pixelsOf: (file) =>
          this.#engine.with((normalight) =>
            normalight.thumbnail(file, { color: this.#settings.color, side: WHOLE }),
          ),
      });
      if (mask) this.#settings.drawnMask(mask);
    } catch (error) {
      sayError(this.#problem, error);
    }
    this.#button.disabled = false;
    this.#button.focus();
  }

  /** The mask that counts now. */
  async #begin() {
    const { mask = "auto" } = this.#settings.options;
    if (mask === "none") return INSIDE;
    if (mask instanceof File && this.#settings.maskIsDrawn) return mask;
    return await this.#ask(mask);
  }

  #ask(mask: NonNullable<EstimateOptions["mask"]>) {
    const { color } = this.#settings;
    return this.#engine.with((normalight) => normalight.mask(this.#stack.files, { color, mask }));
  }
}
