import type { DeriveOptions, Estimate, MeshFileFormat } from "normalight";
import { byId, say, sayError } from "./dom.js";
import type { Kept } from "./downloads.js";
import type { Engine } from "./engine.js";
import type { Depth, Format } from "./maps.js";
import { texts } from "./texts/texts.js";

/** What was made of a result. */
export interface Made {
  readonly depth: Depth;
  readonly files: readonly Kept[];
}

/** Depth, meshes and maps, made of a result when they are asked for. */
export class Derive {
  readonly #button = byId<HTMLButtonElement>("derive");
  readonly #status = byId("derive-status");
  readonly #problem = byId("derive-problem");
  #estimate: Estimate | undefined;

  /**
   * @param format which way green points in maps
   * @param made hears of what the button made of the result that is shown
   */
  constructor(
    private readonly engine: Engine,
    private readonly format: () => Format,
    private readonly made: (made: Made) => void,
  ) {
    this.#button.addEventListener("click", async () => {
      const wished = await this.make(this.#wishes());
      if (wished) this.made(wished);
    });
  }

  /** Takes another result. */
  show(estimate: Estimate): void {
    this.#estimate = estimate;
    say(this.#status, "");
    say(this.#problem, "");
  }

  /** Makes the depth, and what else is wished; nothing where that fails, which the page then says. */
  async make(wishes: DeriveOptions): Promise<Made | undefined> {
    const estimate = this.#estimate;
    if (!estimate || this.#button.disabled) return undefined;
    this.#button.disabled = true;
    say(this.#problem, "");
    say(this.#status, texts.derive.making);
    try {
      const began = performance.now();
      const { depth, files, report } = await this.engine.with((normalight) =>
        normalight.derive(estimate, wishes),
      );
      if (this.#estimate !== estimate) return undefined;
      const seconds = (performance.now() - began) / 1000;
      const [low, high] = report.range;
      say(this.#status, texts.derive.made(seconds, high - low, report.parts));
      return { depth, files };
    } catch (error) {
      if (this.#estimate === estimate) {
        say(this.#status, "");
        sayError(this.#problem, error);
      }
      return undefined;
    } finally {
      this.#button.disabled = false;
    }
  }

  #wishes(): DeriveOptions {
    const wished = (name: string) => byId<HTMLInputElement>(`derive-${name}`).checked;
    const mesh = byId<HTMLSelectElement>("derive-mesh").value;
    return {
      heights: wished("heights"),
      ...(mesh === "" ? {} : { mesh: mesh as MeshFileFormat }),
      maps: wished("maps") && { normalFormat: this.format() },
      flatten: wished("flatten"),
      tileable: wished("tileable"),
    };
  }
}
