import type { Estimate } from "normalight";
import { byId } from "./dom.js";
import { Surface } from "./surface.js";
import { towards } from "./vector.js";

/** Longest side of the picture that is lit anew at every move, in pixels. */
const SIDE = 560;

/** The picture whose lamp follows the pointer and the arrow keys. */
export class Relight {
  readonly #canvas = byId<HTMLCanvasElement>("relight");
  readonly #lamp = byId("lamp");
  #surface: Surface | undefined;
  /** The lamp in the unit square around the middle, y up. */
  #place: [number, number] = [-0.45, 0.5];
  #waiting = false;

  constructor() {
    const albedo = byId<HTMLInputElement>("relight-albedo");
    albedo.addEventListener("change", () => {
      if (this.#surface) this.#surface.coloured = albedo.checked;
      this.#draw();
    });
    this.#canvas.addEventListener("pointermove", (event) => {
      const { left, top, width, height } = this.#canvas.getBoundingClientRect();
      const x = ((event.clientX - left) / width) * 2 - 1;
      this.shineFrom(x, 1 - ((event.clientY - top) / height) * 2);
    });
    this.#canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step) return;
      event.preventDefault();
      const [x, y] = this.#place;
      this.shineFrom(x + 0.08 * (step[0] ?? 0), y + 0.08 * (step[1] ?? 0));
    });
  }

  /** Takes a result. */
  show(estimate: Estimate): void {
    this.#surface = surfaceOf(estimate);
    this.#surface.coloured = byId<HTMLInputElement>("relight-albedo").checked;
    this.#canvas.width = this.#surface.width;
    this.#canvas.height = this.#surface.height;
    this.#canvas.parentElement?.style.setProperty(
      "--ratio",
      String(this.#surface.width / this.#surface.height),
    );
    this.#draw();
  }

  /** Moves the lamp to the direction with this x and y. */
  shineFrom(x: number, y: number): void {
    this.#place = [Math.min(Math.max(x, -1), 1), Math.min(Math.max(y, -1), 1)];
    if (this.#waiting) return;
    this.#waiting = true;
    requestAnimationFrame(() => {
      this.#waiting = false;
      this.#draw();
    });
  }

  #draw(): void {
    const [x, y] = this.#place;
    this.#surface?.draw(this.#canvas, towards(x, y), 1.15);
    this.#lamp.style.left = `${50 + 50 * x}%`;
    this.#lamp.style.top = `${50 - 50 * y}%`;
  }
}

/** The result's surface, in fewer pixels where it is large. */
function surfaceOf({ width, height, albedo, normalMap }: Estimate): Surface {
  const normals = normalMap.data;
  const step = Math.ceil(Math.max(width, height) / SIDE);
  if (step <= 1) return new Surface(width, height, normals, albedo);
  const [columns, rows] = [Math.floor(width / step), Math.floor(height / step)];
  const fewerNormals = new Float32Array(3 * columns * rows);
  const fewerColours = new Uint8Array(4 * columns * rows);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const [to, from] = [row * columns + column, (row * width + column) * step];
      fewerNormals.set(normals.subarray(3 * from, 3 * from + 3), 3 * to);
      fewerColours.set(albedo.subarray(4 * from, 4 * from + 4), 4 * to);
    }
  }
  return new Surface(columns, rows, fewerNormals, fewerColours);
}
