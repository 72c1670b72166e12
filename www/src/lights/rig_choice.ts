import { byId, say } from "../dom.js";
import { texts } from "../texts/texts.js";
import { toCsv } from "./light_text.js";
import type { Rig, Rigs } from "./rigs.js";

/** The rigs among the settings: which one is used, its name, and whether it is still needed. */
export class RigChoice {
  readonly #rigs: Rigs;
  readonly #radio: HTMLInputElement;
  readonly #box = byId("rig-choice");
  readonly #select = byId<HTMLSelectElement>("rig-select");
  readonly #name = byId<HTMLInputElement>("rig-name");
  readonly #words = byId("rig-words");

  constructor(form: HTMLFormElement, rigs: Rigs) {
    this.#rigs = rigs;
    const radio = form.querySelector<HTMLInputElement>('input[name="lights"][value="rig"]');
    if (radio === null) throw new Error("the page has no choice of a rig");
    this.#radio = radio;
    form.addEventListener("change", () => this.#show());
    this.#select.addEventListener("change", () => this.#show());
    this.#name.addEventListener("change", () => this.#rename());
    byId("rig-delete").addEventListener("click", () => this.#delete());
    rigs.onChange(() => this.#list());
    this.#list();
  }

  /** The rig that is to be used. */
  get rig(): Rig | undefined {
    return this.#radio.checked ? this.#chosen : undefined;
  }

  /** The name of the rig in the list, used or not. */
  get chosen(): string {
    return this.#select.value;
  }

  /** Chooses a rig by its name; one that is gone is not used. */
  set chosen(name: string) {
    if (this.#rigs.all.some((rig) => rig.name === name)) this.#select.value = name;
    else if (this.#radio.checked) this.#leave();
    this.#show();
  }

  /** Why the rig does not fit to so many photographs; empty when it does. */
  lacking(photographs: number): string {
    const { rig } = this;
    if (!rig || rig.lights.length === photographs) return "";
    return texts.lights.rigLacking(rig.name, rig.lights.length, photographs);
  }

  /** The rig's lights for photographs in their order. */
  fileFor(photographs: readonly File[]): File | undefined {
    const { rig } = this;
    if (!rig) return undefined;
    const lights = rig.lights.map((light, index) => ({
      ...light,
      file: photographs[index]?.name ?? light.file,
    }));
    return new File([toCsv(lights)], "lights.csv", { type: "text/csv" });
  }

  get #chosen(): Rig | undefined {
    return this.#rigs.all.find(({ name }) => name === this.#select.value);
  }

  #list(): void {
    const before = this.#select.value;
    const { all } = this.#rigs;
    this.#select.replaceChildren(
      ...all.map(({ name, lights }) => new Option(texts.lights.rig(name, lights.length), name)),
    );
    if (all.some(({ name }) => name === before)) this.#select.value = before;
    this.#radio.disabled = all.length === 0;
    if (all.length === 0 && this.#radio.checked) this.#leave();
    this.#show();
  }

  /** The lights are estimated, as there is no such rig. */
  #leave(): void {
    const first = this.#radio.form?.querySelector<HTMLInputElement>('input[name="lights"]');
    if (first) first.checked = true;
    first?.dispatchEvent(new Event("change", { bubbles: true }));
  }

  #show(): void {
    this.#box.hidden = !this.#radio.checked;
    this.#name.value = this.#chosen?.name ?? "";
    say(this.#words, "");
  }

  #rename(): void {
    const from = this.#select.value;
    const to = this.#name.value.trim();
    if (!this.#rigs.rename(from, to)) {
      this.#name.value = from;
      say(this.#words, to === "" ? texts.lights.rigUnnamed : texts.lights.rigTaken(to));
      return;
    }
    this.#select.value = to;
    this.#show();
  }

  #delete(): void {
    this.#rigs.delete(this.#select.value);
    if (this.#box.hidden) this.#radio.form?.querySelector<HTMLElement>('input[name="lights"]')?.focus();
    else this.#select.focus();
  }
}
