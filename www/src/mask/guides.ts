import type { Place } from "./shapes.js";

const SVG = "http://www.w3.org/2000/svg";

/** Lines over the photograph: how large the brush is, and the polygon that is being drawn. */
export class Guides {
  readonly element = shape("svg", "mask-guides");
  readonly #brush = shape("circle", "brush");
  readonly #line = shape("polyline", "line");
  readonly #corners = shape("g", "corners");

  constructor() {
    this.element.setAttribute("aria-hidden", "true");
    this.element.append(this.#line, this.#corners, this.#brush);
  }

  /** @param radius in CSS pixels; none hides it */
  brush({ x, y }: Place, radius: number): void {
    set(this.#brush, { cx: x, cy: y, r: radius });
  }

  hideBrush(): void {
    set(this.#brush, { r: 0 });
  }

  /** Corners that were set, and the place that may become the next. */
  polygon(corners: readonly Place[], next: Place): void {
    const line = corners.length > 0 ? [...corners, next] : [];
    this.#line.setAttribute("points", line.map(({ x, y }) => `${x},${y}`).join(" "));
    const dots = corners.map(({ x, y }) => set(shape("circle"), { cx: x, cy: y, r: 4 }));
    this.#corners.replaceChildren(...dots);
  }
}

function shape<K extends keyof SVGElementTagNameMap>(name: K, className = ""): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, name);
  if (className) element.setAttribute("class", className);
  return element;
}

function set<E extends Element>(element: E, values: Readonly<Record<string, number>>): E {
  for (const [name, value] of Object.entries(values)) element.setAttribute(name, value.toFixed(2));
  return element;
}
