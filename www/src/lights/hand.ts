import type { Estimate, EstimateOptions } from "normalight";
import { byId, make, say, sayError, sayLines } from "../dom.js";
import type { Stack } from "../stack.js";
import { texts } from "../texts/texts.js";
import { coverage } from "./coverage.js";
import { LightDetail } from "./detail.js";
import { Hemisphere } from "./hemisphere.js";
import { LightKeep } from "./keep.js";
import { directed, type HandLight } from "./light.js";
import { toCsv } from "./light_text.js";
import type { Rigs } from "./rigs.js";
import { LightTable } from "./table.js";

/** Lights in the hand as they are kept for a reload: as they are, and as the estimate has them. */
export interface Hand {
  readonly lights: readonly HandLight[];
  readonly left: readonly number[];
  readonly found: readonly HandLight[];
  readonly foundLeft: readonly number[];
}

/** Whether somebody has changed these lights. */
export function isChanged({ lights, left, found }: Hand): boolean {
  return left.length > 0 || lights.some((light, index) => light !== found[index]);
}

/** What the hand needs of the page. */
export interface HandPage {
  readonly stack: Stack;
  readonly rigs: Rigs;
  /** Estimates normals with other files and settings; whether it came to an end. */
  again(files: File[], options: Pick<EstimateOptions, "lights" | "mask">): Promise<void>;
  /** Shows the object under a lamp in this direction. */
  shine(x: number, y: number): void;
  /** The lights were changed. */
  changed(): void;
}

/** Furthest from the middle that a light is dragged: a lamp in the plane of the picture lights nothing. */
const RIM = 0.996;

/** The lights of a result in the hand: looked at, corrected, left out, kept, and the normals estimated anew from them. */
export class LightHand {
  readonly #page: HandPage;
  readonly #map: Hemisphere;
  readonly #detail: LightDetail;
  readonly #table: LightTable;
  readonly #words = make("p", "light-words");
  readonly #again = make("button", "accent", texts.lights.again);
  readonly #undo = make("button", "quiet", texts.lights.undo);
  readonly #coverage = make("ul", "notes");
  #lights: HandLight[] = [];
  /** As the estimate has them. */
  #found: HandLight[] = [];
  readonly #left = new Set<number>();
  #foundLeft: ReadonlySet<number> = new Set();
  #selected = 0;
  #estimate: Estimate | undefined;
  /** The estimate that comes next is made from these lights: those that were left out stay in the list. */
  #own = false;

  constructor(page: HandPage) {
    this.#page = page;
    this.#map = new Hemisphere({
      select: (index) => this.#select(index),
      point: (index) => this.#point(index),
      move: (index, x, y) => this.#move(index, x, y),
      toggle: (index) => this.#use(index, this.#left.has(index)),
    });
    this.#detail = new LightDetail({
      change: (light) => this.#change(this.#selected, light),
      use: (used) => this.#use(this.#selected, used),
    });
    this.#table = new LightTable(byId("lights"), {
      select: (index) => this.#select(index),
      point: (index) => this.#point(index),
      use: (index, used) => this.#use(index, used),
    });
    new LightKeep(byId("light-tools"), page.rigs, {
      lights: () => this.#used().map(({ light }) => light),
      load: (lights) => this.#load(lights),
    });
    this.#build();
  }

  /** Takes the lights of a result. */
  show(estimate: Estimate): void {
    this.#estimate = estimate;
    const lights = estimate.lights.map((light) => ({ ...light }));
    if (this.#own) {
      // Those that were left out keep their place in the list, and can be used again.
      const found = new Map(lights.map((light) => [light.file, light]));
      this.#lights = this.#lights.map((light) => found.get(light.file) ?? light);
    } else {
      this.#lights = lights;
      this.#left.clear();
      this.#selected = 0;
    }
    this.#found = [...this.#lights];
    this.#foundLeft = new Set(this.#left);
    this.#draw();
  }

  /** The lights and what was done to them; nothing before a result. */
  get held(): Hand | undefined {
    if (!this.#estimate) return undefined;
    const [lights, left] = [[...this.#lights], [...this.#left]];
    return { lights, left, found: [...this.#found], foundLeft: [...this.#foundLeft] };
  }

  /** Takes lights as they were held; the result that they belong to is shown. */
  hold({ lights, left, found, foundLeft }: Hand): void {
    // A light that is in both lists has not changed; the browser's copies are one object, too.
    this.#lights = [...lights];
    this.#found = [...found];
    this.#left.clear();
    for (const index of left) this.#left.add(index);
    this.#foundLeft = new Set(foundLeft);
    this.#draw();
  }

  #build(): void {
    for (const button of [this.#again, this.#undo]) button.type = "button";
    this.#words.setAttribute("role", "status");
    this.#coverage.id = "light-coverage";
    this.#again.id = "lights-again";
    this.#undo.id = "lights-undo";
    this.#again.addEventListener("click", () => void this.#estimateAgain());
    this.#undo.addEventListener("click", () => {
      this.#lights = [...this.#found];
      this.#left.clear();
      for (const index of this.#foundLeft) this.#left.add(index);
      this.#draw();
      this.#map.element.querySelector<SVGElement>('[aria-selected="true"]')?.focus();
    });
    const buttons = make("div", "buttons", this.#again, this.#undo);
    const hand = make("div", "light-hand", this.#coverage, this.#detail.element, this.#words, buttons);
    byId("light-map").replaceChildren(this.#map.element, hand);
  }

  #select(index: number): void {
    this.#selected = index;
    this.#point(index);
    this.#draw();
  }

  #point(index: number): void {
    const light = this.#lights[index];
    if (light) this.#page.shine(light.x, light.y);
  }

  #move(index: number, x: number, y: number): void {
    const light = this.#lights[index];
    const length = Math.hypot(x, y);
    const scale = length > RIM ? RIM / length : 1;
    const [a, b] = [x * scale, y * scale];
    const moved = light && directed(light, a, b, Math.sqrt(1 - a * a - b * b));
    if (moved) this.#change(index, moved);
  }

  #change(index: number, light: HandLight): void {
    // A light that somebody has set is a sure one.
    this.#lights[index] = { ...light, confidence: 1 };
    this.#point(index);
    this.#draw();
  }

  #use(index: number, used: boolean): void {
    if (used) this.#left.delete(index);
    else this.#left.add(index);
    this.#draw();
  }

  /** Lights of a file in place of these: by the photographs' names, else in their order. */
  #load(lights: readonly HandLight[]): void {
    const named = new Map(lights.map((light) => [light.file, light]));
    const byName = this.#lights.some(({ file }) => named.has(file));
    if (!byName && lights.length !== this.#lights.length)
      throw new Error(texts.lights.otherCount(lights.length, this.#lights.length));
    this.#lights = this.#lights.map((light, index) => {
      const other = byName ? named.get(light.file) : lights[index];
      return other ? { ...other, file: light.file } : light;
    });
    this.#draw();
  }

  #used(): { light: HandLight; index: number }[] {
    return this.#lights
      .map((light, index) => ({ light, index }))
      .filter(({ index }) => !this.#left.has(index));
  }

  /** A photograph can be seen now. */
  pictured(): void {
    const selected = this.#lights[this.#selected];
    if (selected) this.#detail.draw(this.#page.stack.pictureOf(selected.file));
  }

  #draw(): void {
    const selected = this.#lights[this.#selected];
    this.#map.show(this.#lights, this.#left, this.#selected);
    if (selected)
      this.#detail.show(selected, !this.#left.has(this.#selected), this.#page.stack.pictureOf(selected.file));
    this.#table.show(this.#lights, this.#left, this.#selected);
    sayLines(
      this.#coverage,
      coverage(this.#used().map(({ light }) => light)).map((line) => `notice: ${line}`),
    );
    const moved = this.#lights.filter((light, index) => light !== this.#found[index]).length;
    const leftOut = this.#left.size;
    const changed = moved > 0 || !sameSets(this.#left, this.#foundLeft);
    const tooFew = this.#lights.length - leftOut < 3;
    say(this.#words, tooFew ? texts.lights.tooFew : texts.lights.changes(moved, leftOut));
    this.#again.disabled = !changed || tooFew;
    this.#undo.disabled = !changed;
    this.#page.changed();
  }

  /** The normals anew from these lights; the stage that estimates lights is left out. */
  async #estimateAgain(): Promise<void> {
    const used = this.#used();
    const { stack } = this.#page;
    const photographs = used.map(({ light }) => stack.fileOf(light.file));
    const present = photographs.filter((file) => file !== undefined);
    if (present.length < used.length || !this.#estimate) {
      say(this.#words, texts.lights.gone);
      return;
    }
    const { files, plan } = this.#estimate;
    const ambient = plan.ambient === undefined ? undefined : stack.fileOf(plan.ambient);
    // The very pixels of this result, wherever they came from.
    const mask = files.find(({ name }) => name === "mask.png");
    // The names as the bench has them: those of the result may be shorter.
    const named = used.map(({ light }, at) => ({ ...light, file: present[at]?.name ?? light.file }));
    this.#own = true;
    try {
      await this.#page.again(ambient ? [...present, ambient] : present, {
        lights: new File([toCsv(named)], "lights.csv", { type: "text/csv" }),
        ...(mask ? { mask: new File([mask.bytes], "mask.png", { type: "image/png" }) } : {}),
      });
    } catch (error) {
      sayError(this.#words, error);
    } finally {
      this.#own = false;
    }
  }
}

function sameSets(a: ReadonlySet<number>, b: ReadonlySet<number>): boolean {
  return a.size === b.size && [...a].every((value) => b.has(value));
}
