import { byId, make, write } from "../dom.js";
import { texts } from "../texts/texts.js";
import { towards } from "../vector.js";
import { FIRST, type Lamp, MOST_LAMPS } from "./shading.js";

/** How far an arrow key moves a lamp. */
const STEP = 0.08;

/** Where further lamps begin. */
const PLACES = [FIRST, { x: 0.55, y: 0.2 }, { x: -0.1, y: -0.6 }, { x: 0.2, y: 0.65 }];

const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** The lamps, and the hemisphere on which they are dragged. */
export class Lamps {
  readonly #pad = byId("lamps");
  readonly #brightness = byId<HTMLInputElement>("lamp-brightness");
  readonly #words = byId("lamp-brightness-words");
  readonly #add = byId<HTMLButtonElement>("lamp-add");
  readonly #remove = byId<HTMLButtonElement>("lamp-remove");
  #handles: HTMLButtonElement[] = [];
  #all: readonly Lamp[] = [FIRST];
  #chosen = 0;

  constructor(private readonly changed: () => void) {
    this.#add.addEventListener("click", () => this.#more());
    this.#remove.addEventListener("click", () => {
      const left = this.#all.filter((_, index) => index !== this.#chosen);
      this.set(left, Math.max(this.#chosen - 1, 0));
      // The last but one: its button is disabled now, and would take the focus with it.
      if (this.#remove.disabled) this.#add.focus();
    });
    this.#brightness.addEventListener("input", () =>
      this.#change({ brightness: this.#brightness.valueAsNumber }),
    );
    // A press beside the handles takes the chosen lamp there.
    this.#pad.addEventListener("pointerdown", (event) => {
      const handle = this.#handles.indexOf(event.target as HTMLButtonElement);
      if (handle >= 0) this.#choose(handle);
      this.#pad.setPointerCapture(event.pointerId);
      this.#follow(event);
    });
    this.#pad.addEventListener("pointermove", (event) => {
      if (this.#pad.hasPointerCapture(event.pointerId)) this.#follow(event);
    });
    this.#show();
  }

  get all(): readonly Lamp[] {
    return this.#all;
  }

  /** Other lamps. */
  set(all: readonly Lamp[], chosen = 0): void {
    this.#all = all;
    this.#chosen = chosen;
    this.#show();
    this.changed();
  }

  /** The chosen lamp goes to the direction with this x and y. */
  moveTo(x: number, y: number): void {
    const [a, b] = towards(x, y);
    this.#change({ x: a, y: b });
  }

  /** The chosen lamp moves by steps. */
  moveBy(right: number, up: number): void {
    const { x, y } = this.#all[this.#chosen] ?? FIRST;
    this.moveTo(x + STEP * right, y + STEP * up);
  }

  #more(): void {
    const place = PLACES[this.#all.length] ?? FIRST;
    this.set([...this.#all, { brightness: 0.6, ...place }].slice(0, MOST_LAMPS), this.#all.length);
    this.#handles[this.#chosen]?.focus();
  }

  #choose(index: number): void {
    this.#chosen = index;
    this.#show();
  }

  #change(some: Partial<Lamp>): void {
    this.#all = this.#all.map((lamp, index) => (index === this.#chosen ? { ...lamp, ...some } : lamp));
    this.#show();
    this.changed();
  }

  #follow({ clientX, clientY }: PointerEvent): void {
    const { left, top, width, height } = this.#pad.getBoundingClientRect();
    this.moveTo(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2);
  }

  #show(): void {
    while (this.#handles.length > this.#all.length) this.#handles.pop()?.remove();
    while (this.#handles.length < this.#all.length) this.#handles.push(this.#handle(this.#handles.length));
    for (const [index, handle] of this.#handles.entries()) {
      const lamp = this.#all[index] ?? FIRST;
      handle.style.left = `${50 + 50 * lamp.x}%`;
      handle.style.top = `${50 - 50 * lamp.y}%`;
      handle.setAttribute("aria-pressed", String(index === this.#chosen));
      handle.setAttribute("aria-label", texts.relight.lamp(index + 1, directionWords(lamp)));
    }
    const { brightness } = this.#all[this.#chosen] ?? FIRST;
    this.#brightness.valueAsNumber = brightness;
    write(this.#words, texts.relight.percent(brightness));
    this.#add.disabled = this.#all.length >= MOST_LAMPS;
    this.#remove.disabled = this.#all.length <= 1;
    write(byId("lamp-words"), texts.relight.chosen(this.#chosen + 1, this.#all.length));
  }

  #handle(index: number): HTMLButtonElement {
    const handle = make("button", "lamp", String(index + 1));
    handle.type = "button";
    handle.addEventListener("focus", () => {
      if (this.#chosen !== index) this.#choose(index);
    });
    handle.addEventListener("keydown", (event) => {
      const arrow = ARROWS[event.key];
      if (!arrow) return;
      event.preventDefault();
      this.moveBy(...arrow);
    });
    this.#pad.append(handle);
    return handle;
  }
}

/** A direction as people say it. */
export function directionWords({ x, y }: Pick<Lamp, "x" | "y">): string {
  const degrees = Math.round((Math.asin(Math.min(Math.hypot(x, y), 1)) * 180) / Math.PI);
  if (degrees < 4) return texts.directions.straight;
  const turn = Math.round(Math.atan2(y, x) / (Math.PI / 4) + 8) % 8;
  return texts.directions.from(turn, degrees);
}
