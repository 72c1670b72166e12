import type { ColorMode, DeviceChoice, EstimateOptions, Quality } from "normalight";
import type { AmbientChoice } from "./ambient.js";
import { byId, chosen } from "./dom.js";
import { lightsOf, toCsv } from "./lights/light_text.js";
import { RigChoice } from "./lights/rig_choice.js";
import type { Rigs } from "./lights/rigs.js";
import { texts } from "./texts/texts.js";

/** How the page made a file. */
type Made = keyof typeof texts.settings.made;

/** A file of a setting: the user's, or one that the page made. */
interface KeptFile {
  readonly file: File;
  readonly made?: Made | undefined;
}

/** The form's settings as they are kept for a reload. */
export interface KeptSettings {
  /** What is chosen, by the names of the form. */
  readonly values: Readonly<Record<string, string>>;
  readonly rig: string;
  readonly ownColor: ColorMode | undefined;
  readonly mask: KeptFile | undefined;
  readonly maskIsDrawn: boolean;
  readonly lights: KeptFile | undefined;
}

/** A setting that may be a file: its radio button asks for one. */
class FileSetting {
  readonly #form: HTMLFormElement;
  readonly #name: string;
  readonly #label: HTMLElement;
  #kept: KeptFile | undefined;

  /**
   * @param changed hears of another file
   * @param convert brings a file into a form that the estimator reads
   */
  constructor(
    form: HTMLFormElement,
    name: string,
    changed: () => void,
    convert = async (file: File) => file,
  ) {
    this.#form = form;
    this.#name = name;
    this.#label = byId(`${name}-name`);
    const input = byId<HTMLInputElement>(`${name}-file`);
    const radio = form.querySelector<HTMLInputElement>(`input[name="${name}"][value="file"]`);
    // A click on the chosen button asks again: `change` would not come.
    radio?.addEventListener("click", () => input.click());
    input.addEventListener("change", async () => {
      const [file] = input.files ?? [];
      input.value = "";
      if (!file) return;
      this.#kept = { file: await convert(file) };
      this.#label.textContent = file.name;
      changed();
    });
    input.addEventListener("cancel", () => {
      if (!this.#kept) form.querySelector<HTMLInputElement>(`input[name="${name}"]`)?.click();
    });
  }

  /** Takes a file that the page made or has kept. */
  give(kept: KeptFile): void {
    this.#kept = kept;
    this.#label.textContent = kept.made ? texts.settings.made[kept.made] : kept.file.name;
    const radio = this.#form.querySelector<HTMLInputElement>(`input[name="${this.#name}"][value="file"]`);
    if (radio) radio.checked = true;
  }

  /** The file belonged to other photographs: the first choice counts again. */
  forget(): void {
    if (!this.#kept) return;
    this.#kept = undefined;
    this.#label.textContent = texts.settings.file;
    if (chosen(this.#form, this.#name) !== "file") return;
    const first = this.#form.querySelector<HTMLInputElement>(`input[name="${this.#name}"]`);
    if (first) first.checked = true;
  }

  /** The file that was chosen, used or not. */
  get kept(): KeptFile | undefined {
    return this.#kept;
  }

  /** The file, when one was chosen and is to be used. */
  get file(): File | undefined {
    return chosen(this.#form, this.#name) === "file" ? this.#kept?.file : undefined;
  }
}

/** Lights in our JSON as a table, which the estimator reads; other files as they are, it says what is wrong with them. */
async function tableOf(file: File): Promise<File> {
  if (!/\.json$/i.test(file.name)) return file;
  try {
    return new File([toCsv(lightsOf(await file.text(), file.name))], "lights.csv", { type: "text/csv" });
  } catch {
    return file;
  }
}

/** What the form says about how to estimate. */
export class Settings {
  readonly #form: HTMLFormElement;
  readonly #mask: FileSetting;
  readonly #lights: FileSetting;
  readonly #rig: RigChoice;
  readonly #changed: { device(): void; color(): void; any(): void };
  /** The user's colour, while files that know their own have theirs. */
  #ownColor: ColorMode | undefined;
  readonly #ambient: AmbientChoice;
  #drawn: File | undefined;

  constructor(
    form: HTMLFormElement,
    rigs: Rigs,
    ambient: AmbientChoice,
    changed: { device(): void; color(): void; any(): void },
  ) {
    this.#form = form;
    this.#ambient = ambient;
    this.#changed = changed;
    this.#mask = new FileSetting(form, "mask", changed.any);
    this.#lights = new FileSetting(form, "lights", changed.any, tableOf);
    this.#rig = new RigChoice(form, rigs);
    form.addEventListener("change", ({ target }) => {
      const name = target instanceof HTMLInputElement ? target.name : "";
      if (name === "color") this.#ownColor = undefined;
      this.#showAxes();
      if (name === "device" || name === "color") changed[name]();
      changed.any();
    });
  }

  /** Takes a mask that was drawn on the photographs. */
  drawnMask(mask: File): void {
    this.#drawn = mask;
    this.#mask.give({ file: mask, made: "drawn" });
    this.#changed.any();
  }

  /** Takes lights that were set by hand, for the next run. */
  handLights(lights: File): void {
    this.#lights.give({ file: lights, made: "hand" });
    this.#showAxes();
    this.#changed.any();
  }

  /** Whether the mask that counts is the drawn one. */
  get maskIsDrawn(): boolean {
    return this.#drawn !== undefined && this.#mask.file === this.#drawn;
  }

  /** Other photographs are taken: mask and lights of the last ones do not belong to them. */
  forgetFiles(): void {
    this.#mask.forget();
    this.#lights.forget();
    byId("light-axes").hidden = true;
  }

  #showAxes(): void {
    byId("light-axes").hidden = chosen(this.#form, "lights") !== "file";
  }

  /** Everything, for a reload. */
  get kept(): KeptSettings {
    const fields = [...new FormData(this.#form)];
    const values = fields.filter((field): field is [string, string] => typeof field[1] === "string");
    return {
      values: Object.fromEntries(values),
      rig: this.#rig.chosen,
      ownColor: this.#ownColor,
      mask: this.#mask.kept,
      maskIsDrawn: this.maskIsDrawn,
      lights: this.#lights.kept,
    };
  }

  /** Sets everything as it was kept. */
  restore({ values, rig, ownColor, mask, maskIsDrawn, lights }: KeptSettings): void {
    const before = { device: this.device, color: this.color };
    if (mask) this.#mask.give(mask);
    this.#drawn = maskIsDrawn ? mask?.file : undefined;
    if (lights) this.#lights.give(lights);
    for (const [name, value] of Object.entries(values)) {
      const field = this.#form.elements.namedItem(name);
      if (field instanceof RadioNodeList || field instanceof HTMLSelectElement) field.value = value;
    }
    this.#rig.chosen = rig;
    this.#ownColor = ownColor;
    this.#showAxes();
    if (this.device !== before.device) this.#changed.device();
    if (this.color !== before.color) this.#changed.color();
  }

  get device(): DeviceChoice {
    return chosen(this.#form, "device") as DeviceChoice;
  }

  get color(): ColorMode {
    return chosen(this.#form, "color") as ColorMode;
  }

  /** Sets the colour to what files are known to hold. */
  lendColor(color: ColorMode): void {
    this.#ownColor ??= this.color;
    this.#setColor(color);
  }

  /** Those files are gone: the user's choice counts again. */
  returnColor(): void {
    if (this.#ownColor === undefined) return;
    this.#setColor(this.#ownColor);
    this.#ownColor = undefined;
  }

  #setColor(color: ColorMode): void {
    if (color === this.color) return;
    const radio = this.#form.querySelector<HTMLInputElement>(`input[name="color"][value="${color}"]`);
    if (radio) radio.checked = true;
    this.#changed.color();
  }

  /** Why these settings do not fit to so many photographs; empty when they do. */
  lacking(photographs: number): string {
    return this.#rig.lacking(photographs);
  }

  /** The settings of a run on these photographs: a rig gives each its light. */
  optionsFor(photographs: readonly File[]): EstimateOptions {
    const lights = this.#rig.fileFor(photographs);
    return lights ? { ...this.options, lights } : this.options;
  }

  /** The settings for a run on files that were chosen from the stack: its masks and lights are given with them. */
  get optionsOfPart(): EstimateOptions {
    const { images: _images, lights: _lights, lightAxes: _axes, ...others } = this.options;
    return others;
  }

  /** The settings for photographs that are not on the bench: a mask and lights of files belong to those that are. */
  optionsOfOthers(photographs: readonly File[]): EstimateOptions {
    const { lights: _lights, lightAxes: _axes, mask, ...others } = this.options;
    const lights = this.#rig.fileFor(photographs);
    return { ...others, mask: mask === "none" ? "none" : "auto", ...(lights ? { lights } : {}) };
  }

  get options(): EstimateOptions {
    const lights = this.#lights.file;
    const images = chosen(this.#form, "images");
    const wholeFrame = chosen(this.#form, "mask") === "none";
    return {
      color: this.color,
      mask: this.#mask.file ?? (wholeFrame ? "none" : "auto"),
      ...(lights ? { lights, lightAxes: chosen(this.#form, "light-axes") } : {}),
      ...(images === "all" ? {} : { images: Number(images) }),
      ambient: this.#ambient.setting,
      align: chosen(this.#form, "align") === "yes",
      quality: chosen(this.#form, "quality") as Quality,
      normalFormat: chosen(this.#form, "normal-format") as "opengl" | "directx",
    };
  }
}
