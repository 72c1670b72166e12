import { make, say, sayError } from "../dom.js";
import { texts } from "../texts/texts.js";
import type { Picture } from "./picture.js";

/** A map that can be chosen. */
export interface Layer {
  readonly id: string;
  readonly name: string;
  /** The heading under which it stands in the list. */
  readonly group?: string;
  /** The picture of it; what takes long may come later. */
  load(): Picture | Promise<Picture>;
}

/** A list of maps of which one is chosen, and its picture. */
export class Choice {
  picture: Picture | undefined;
  #layers: readonly Layer[] = [];
  #loading: Layer | undefined;

  /**
   * @param nothing what stands for no map, where none may be chosen
   * @param changed hears when there is another picture
   */
  constructor(
    readonly select: HTMLSelectElement,
    private readonly status: HTMLElement,
    private readonly nothing: string | undefined,
    private readonly changed: () => void,
  ) {
    select.addEventListener("change", () => void this.#load());
  }

  get id(): string {
    return this.select.value;
  }

  /** The chosen map's name. */
  get name(): string {
    return this.select.selectedOptions[0]?.textContent ?? "";
  }

  /** Takes other maps; the chosen one stays chosen, if there is one of that name. */
  offer(layers: readonly Layer[], chosen: string): void {
    this.#layers = layers;
    const options: (HTMLElement | string)[] = this.nothing === undefined ? [] : [option("", this.nothing)];
    let group: HTMLOptGroupElement | undefined;
    for (const { id, name, group: heading } of layers) {
      if (heading === undefined) options.push(option(id, name));
      else {
        if (group?.label !== heading) {
          group = make("optgroup");
          group.label = heading;
          options.push(group);
        }
        group.append(option(id, name));
      }
    }
    this.select.replaceChildren(...options);
    this.choose(chosen);
  }

  /** Chooses a map; the first where there is none of this name. */
  choose(id: string): void {
    this.select.value = id;
    if (this.select.selectedIndex < 0) this.select.selectedIndex = 0;
    void this.#load();
  }

  async #load(): Promise<void> {
    const layer = this.#layers.find(({ id }) => id === this.select.value);
    this.#loading = layer;
    say(this.status, "");
    if (layer === undefined) {
      this.picture = undefined;
      this.changed();
      return;
    }
    try {
      const coming = layer.load();
      if (coming instanceof Promise) say(this.status, texts.viewer.fetching(layer.name));
      const picture = coming instanceof Promise ? await coming : coming;
      // Another one was chosen meanwhile.
      if (this.#loading !== layer) return;
      this.picture = picture;
      say(this.status, "");
    } catch (error) {
      if (this.#loading !== layer) return;
      this.picture = undefined;
      sayError(this.status, error, (why) => texts.viewer.failed(layer.name, why));
    }
    this.changed();
  }
}

function option(value: string, name: string): HTMLOptionElement {
  const made = make("option", "", name);
  made.value = value;
  return made;
}
