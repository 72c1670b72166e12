import { texts } from "../texts/texts.js";
import { elevation, type HandLight, inWords } from "./light.js";

const SVG = "http://www.w3.org/2000/svg";

/** Radii of the rings of lights 60 and 30 degrees above the picture, and of the horizon. */
const RINGS = [0.5, Math.sin(Math.PI / 3), 1];

/** Degrees that a key moves a light. */
const STEP = 2;

/** What people do with the lights. */
export interface HemisphereActions {
  select(index: number): void;
  point(index: number): void;
  move(index: number, x: number, y: number): void;
  toggle(index: number): void;
}

/** The lights seen from the camera: the middle is at the camera, the outer ring is the plane of the picture. */
export class Hemisphere {
  readonly element = shape("svg", { class: "hemisphere", viewBox: "-1.12 -1.12 2.24 2.24" });
  readonly #dots = shape("g", {});
  readonly #actions: HemisphereActions;
  #lights: readonly HandLight[] = [];
  #dragged: number | undefined;

  constructor(actions: HemisphereActions) {
    this.#actions = actions;
    const { element } = this;
    element.setAttribute("role", "listbox");
    element.setAttribute("aria-label", texts.lights.map);
    const rings = RINGS.map((r) => shape("circle", { class: "ring", r }));
    const cross = shape("path", { class: "ring", d: "M-1 0H1M0 -1V1" });
    const words = [texts.directions.left, texts.directions.right].map((word, at) => {
      const text = shape("text", { x: at ? 0.98 : -0.98, y: -0.03, "text-anchor": at ? "end" : "start" });
      text.textContent = word;
      return text;
    });
    const ground = shape("g", { "aria-hidden": "true" });
    ground.append(...rings, cross, ...words);
    element.append(ground, this.#dots);
    element.addEventListener("pointerdown", (event) => this.#down(event));
    element.addEventListener("pointermove", (event) => this.#move(event));
    for (const end of ["pointerup", "pointercancel"])
      element.addEventListener(end, () => {
        this.#dragged = undefined;
      });
    element.addEventListener("keydown", (event) => this.#key(event));
  }

  show(lights: readonly HandLight[], left: ReadonlySet<number>, selected: number): void {
    this.#lights = lights;
    const most = Math.max(...lights.map(({ intensity }) => intensity), 1e-9);
    const dots = lights.map((light, index) => {
      const { file, x, y, intensity, confidence } = light;
      const dot = shape("circle", {
        cx: x,
        cy: -y,
        // A doubtful light is small and pale, whatever its brightness.
        r: 0.032 + 0.03 * confidence,
        "fill-opacity": 0.3 + 0.7 * Math.min(confidence, 1),
        fill: colourOf(intensity / most),
        role: "option",
        tabindex: index === selected ? 0 : -1,
        "aria-selected": String(index === selected),
        "data-light": index,
        class: left.has(index) ? "dot left-out" : "dot",
      });
      const title = shape("title", {});
      title.textContent = texts.lights.dot(file, inWords(light), intensity, confidence, left.has(index));
      dot.setAttribute("aria-label", title.textContent);
      dot.append(title);
      dot.addEventListener("pointerenter", () => this.#actions.point(index));
      return dot;
    });
    const focused = this.#dots.contains(document.activeElement);
    // The selected one lies above the others, where it can be taken.
    const chosen = dots[selected];
    this.#dots.replaceChildren(...dots.filter((dot) => dot !== chosen), ...(chosen ? [chosen] : []));
    if (focused) chosen?.focus({ preventScroll: true });
  }

  #down(event: PointerEvent): void {
    const index = indexOf(event.target);
    if (index === undefined) return;
    event.preventDefault();
    this.#dragged = index;
    this.element.setPointerCapture(event.pointerId);
    this.#actions.select(index);
    this.#dots.querySelector<SVGElement>('[aria-selected="true"]')?.focus({ preventScroll: true });
  }

  #move(event: PointerEvent): void {
    if (this.#dragged === undefined || (event.movementX === 0 && event.movementY === 0)) return;
    const { left, top, width, height } = this.element.getBoundingClientRect();
    const side = Math.min(width, height);
    const x = ((event.clientX - left - width / 2) / side) * 2.24;
    const y = ((top + height / 2 - event.clientY) / side) * 2.24;
    this.#actions.move(this.#dragged, x, y);
  }

  #key(event: KeyboardEvent): void {
    const index = indexOf(event.target);
    if (index === undefined) return;
    const [right, up] = arrows[event.key] ?? [0, 0];
    const { length } = this.#lights;
    if (event.key === "Delete" || event.key === "x") this.#actions.toggle(index);
    else if (right === 0 && up === 0) return;
    else if (event.shiftKey) this.#nudge(index, right, up);
    else this.#actions.select((index + (right - up) + length) % length);
    event.preventDefault();
    this.#dots.querySelector<SVGElement>('[aria-selected="true"]')?.focus({ preventScroll: true });
  }

  #nudge(index: number, right: number, up: number): void {
    const light = this.#lights[index];
    if (!light) return;
    // Near the horizon a step of equal angle is a smaller one on the map.
    const step = ((STEP * Math.PI) / 180) * Math.max(Math.sin((elevation(light) * Math.PI) / 180), 0.2);
    this.#actions.move(index, light.x + right * step, light.y + up * step);
  }
}

const arrows: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

function indexOf(target: EventTarget | null): number | undefined {
  const index = target instanceof SVGElement ? target.dataset.light : undefined;
  return index === undefined ? undefined : Number(index);
}

/** From violet for faint to yellow for bright. */
function colourOf(share: number): string {
  const colours = ["#9a5fe0", "#c0509f", "#dd5e66", "#f58b47", "#fdc328"];
  return colours[Math.min(Math.floor(share * colours.length), colours.length - 1)] ?? "#fff";
}

/** A new part of a drawing with its attributes. */
export function shape<K extends keyof SVGElementTagNameMap>(
  name: K,
  attributes: Readonly<Record<string, string | number>>,
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}
