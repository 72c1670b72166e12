import { make, say, wordsOf } from "../dom.js";
import type { HandLight } from "./light.js";
import { lightsOf, toCsv, toJson, toLp } from "./light_text.js";
import type { Rigs } from "./rigs.js";

/** The files that lights are saved as. */
const FORMATS = {
  "lights.lp": { words: ".lp", type: "text/plain", text: toLp },
  "lights.csv": { words: "CSV", type: "text/csv", text: toCsv },
  "lights.json": { words: "JSON", type: "application/json", text: toJson },
} as const;

/** Where lights go and come from: files, and the rigs of this browser. */
export class LightKeep {
  readonly #rigs: Rigs;
  readonly #hand: { lights(): HandLight[]; load(lights: HandLight[]): void };
  readonly #words = make("p", "notice");
  readonly #name = make("input");

  constructor(
    place: HTMLElement,
    rigs: Rigs,
    hand: { lights(): HandLight[]; load(lights: HandLight[]): void },
  ) {
    this.#rigs = rigs;
    this.#hand = hand;
    this.#words.setAttribute("role", "status");
    say(this.#words, "");
    place.classList.add("light-keep");
    place.append(this.#files(), this.#rig(), this.#words);
  }

  #files(): HTMLElement {
    const picker = make("input");
    Object.assign(picker, { type: "file", hidden: true, id: "hand-file", accept: ".lp,.csv,.json,.txt" });
    picker.setAttribute("aria-label", "File of lights");
    picker.addEventListener("change", async () => {
      const [file] = picker.files ?? [];
      picker.value = "";
      if (file)
        await this.#try(async () => {
          this.#hand.load(lightsOf(await file.text(), file.name));
          say(this.#words, `Lights of ${file.name}: “Estimate normals again” uses them.`);
        });
    });
    const load = make("button", "quiet", "Load…");
    load.type = "button";
    load.title = "Lights from an .lp, our CSV or JSON";
    load.addEventListener("click", () => picker.click());
    const saves = Object.entries(FORMATS).map(([name, { words, type, text }]) => {
      const save = make("button", "quiet", `Save ${words}`);
      save.type = "button";
      save.dataset.save = name;
      save.addEventListener("click", () => download(new File([text(this.#hand.lights())], name, { type })));
      return save;
    });
    return make("div", "buttons", load, ...saves, picker);
  }

  #rig(): HTMLElement {
    const keep = make("button", "quiet", "Keep as rig");
    keep.type = "button";
    keep.id = "rig-keep";
    keep.title = "For the next object under the same lamps; stays in this browser";
    Object.assign(this.#name, { id: "rig-new", placeholder: "name of the rig", maxLength: 60 });
    this.#name.setAttribute("aria-label", "Name of the rig");
    const act = () => void this.#try(() => this.#keep());
    keep.addEventListener("click", act);
    this.#name.addEventListener("keydown", (event) => {
      if (event.key === "Enter") act();
    });
    return make("div", "rig-new", this.#name, keep);
  }

  #keep(): void {
    const name = this.#name.value.trim();
    if (name === "") {
      this.#name.focus();
      throw new Error("Give the rig a name first.");
    }
    const lights = this.#hand.lights();
    this.#rigs.keep({ name, lights });
    this.#name.value = "";
    say(this.#words, `Kept: ${name}, ${lights.length} lights. Choose it under Lights for the next object.`);
  }

  async #try(work: () => unknown): Promise<void> {
    try {
      await work();
    } catch (error) {
      say(this.#words, wordsOf(error));
    }
  }
}

function download(file: File): void {
  const link = make("a");
  link.href = URL.createObjectURL(file);
  link.download = file.name;
  link.click();
  // The browser needs the address until it has read the file.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
