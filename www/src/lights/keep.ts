import { make, say, sayError } from "../dom.js";
import { texts } from "../texts/texts.js";
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
    picker.setAttribute("aria-label", texts.lights.file);
    picker.addEventListener("change", async () => {
      const [file] = picker.files ?? [];
      picker.value = "";
      if (file)
        await this.#try(async () => {
          this.#hand.load(lightsOf(await file.text(), file.name));
          say(this.#words, texts.lights.loaded(file.name));
        });
    });
    const load = make("button", "quiet", texts.lights.load);
    load.type = "button";
    load.title = texts.lights.loadTitle;
    load.addEventListener("click", () => picker.click());
    const saves = Object.entries(FORMATS).map(([name, { words, type, text }]) => {
      const save = make("button", "quiet", texts.lights.save(words));
      save.type = "button";
      save.dataset.save = name;
      save.addEventListener("click", () => download(new File([text(this.#hand.lights())], name, { type })));
      return save;
    });
    return make("div", "buttons", load, ...saves, picker);
  }

  #rig(): HTMLElement {
    const keep = make("button", "quiet", texts.lights.keepRig);
    keep.type = "button";
    keep.id = "rig-keep";
    keep.title = texts.lights.keepRigTitle;
    Object.assign(this.#name, { id: "rig-new", placeholder: texts.lights.rigPlaceholder, maxLength: 60 });
    this.#name.setAttribute("aria-label", texts.lights.rigName);
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
      throw new Error(texts.lights.rigFirst);
    }
    const lights = this.#hand.lights();
    this.#rigs.keep({ name, lights });
    this.#name.value = "";
    say(this.#words, texts.lights.rigKept(name, lights.length));
  }

  async #try(work: () => unknown): Promise<void> {
    try {
      await work();
    } catch (error) {
      sayError(this.#words, error);
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
