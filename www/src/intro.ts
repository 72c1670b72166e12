import { byId, context } from "./dom.js";
import { Surface } from "./surface.js";
import { towards, type Vector } from "./vector.js";

/** Side of the pictures in pixels. */
const SIDE = 300;
/** Least milliseconds from one drawing to the next. */
const PAUSE = 30;
/** Lamps on the map, whose places the moving lamp passes. */
const LAMPS = 14;

/** What the page shows before there is a result: the task in three small pictures, under a moving lamp. */
export class Intro {
  readonly #section = byId("intro");
  readonly #photographs = byId<HTMLCanvasElement>("intro-photographs");
  readonly #lights = byId<HTMLCanvasElement>("intro-lights");
  readonly #surface = shell();
  #pointer: readonly [number, number] | undefined;
  /** The pause before the next drawing, while the lamp moves by itself. */
  #next: number | undefined;

  constructor() {
    this.#section.addEventListener("pointermove", (event) => {
      const { left, top, width, height } = this.#photographs.getBoundingClientRect();
      const x = ((event.clientX - left) / width) * 2 - 1;
      this.#pointer = [x, 1 - ((event.clientY - top) / height) * 2];
      if (this.#next === undefined) this.#draw(0);
    });
    this.#section.addEventListener("pointerleave", () => {
      this.#pointer = undefined;
    });
    this.#drawNormals();
    this.#draw(0.6);
    this.rest(false);
  }

  /** Whether the lamp rests: once there are photographs, the processor is wanted for them. */
  rest(resting: boolean): void {
    clearTimeout(this.#next);
    this.#next = undefined;
    if (!resting && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.#goOn(PAUSE);
  }

  hide(): void {
    this.#section.hidden = true;
  }

  /** Draws after a pause, and so on; twice as long a pause as the drawing takes, since a browser that only draws puts off the rest. */
  #goOn(pause: number): void {
    this.#next = setTimeout(() => {
      const start = performance.now();
      requestAnimationFrame((time) => {
        if (this.#section.hidden || this.#next === undefined) return;
        this.#draw(time / 1000);
        this.#goOn(Math.max(PAUSE, 2 * (performance.now() - start)));
      });
    }, pause);
  }

  #draw(seconds: number): void {
    const lamp = this.#pointer ? towards(...this.#pointer) : path(seconds);
    this.#surface.draw(this.#photographs, lamp, 1.2);
    this.#drawLights(lamp);
  }

  #drawNormals(): void {
    const { normals } = shellShape();
    const pixels = new Uint8ClampedArray(4 * SIDE * SIDE);
    for (let pixel = 0; pixel < SIDE * SIDE; pixel++) {
      const normal = normals.subarray(3 * pixel, 3 * pixel + 3);
      if (normal.every((value) => value === 0)) continue;
      pixels.set([...normal].map((value) => (value * 0.5 + 0.5) * 255).concat(255), 4 * pixel);
    }
    context(byId<HTMLCanvasElement>("intro-normals")).putImageData(new ImageData(pixels, SIDE, SIDE), 0, 0);
  }

  #drawLights([x, y]: Vector): void {
    const drawing = context(this.#lights);
    const [middle, radius] = [SIDE / 2, SIDE * 0.44];
    drawing.clearRect(0, 0, SIDE, SIDE);
    drawing.strokeStyle = "#48515e";
    for (const ring of [1, Math.sin(Math.PI / 3), 0.5]) {
      drawing.beginPath();
      drawing.arc(middle, middle, radius * ring, 0, 2 * Math.PI);
      drawing.stroke();
    }
    for (let lamp = 0; lamp < LAMPS; lamp++) {
      const [a, b] = path((lamp * PERIOD) / LAMPS);
      const near = Math.max(0, 1 - 4 * Math.hypot(a - x, b - y));
      dot(drawing, middle + radius * a, middle - radius * b, 4 + 2 * near, lampColour(lamp));
    }
    dot(drawing, middle + radius * x, middle - radius * y, 6, "#fff");
  }
}

/** Seconds after which the lamp passes the same place. */
const PERIOD = 24;

/** Where the lamp is on its way, a curve that crosses the whole map. */
function path(seconds: number): Vector {
  const turn = (2 * Math.PI * seconds) / PERIOD;
  const reach = 0.55 + 0.3 * Math.cos(5 * turn);
  return towards(reach * Math.cos(2 * turn), reach * Math.sin(2 * turn));
}

function lampColour(lamp: number): string {
  const colours = ["#7d2fb8", "#b13a90", "#dd5e66", "#f58b47", "#fdc328"];
  return colours[(lamp * 3) % colours.length] ?? "#fff";
}

function dot(drawing: CanvasRenderingContext2D, x: number, y: number, radius: number, colour: string): void {
  drawing.fillStyle = colour;
  drawing.beginPath();
  drawing.arc(x, y, radius, 0, 2 * Math.PI);
  drawing.fill();
}

function shell(): Surface {
  const { normals, albedo } = shellShape();
  return new Surface(SIDE, SIDE, normals, albedo);
}

/** A ribbed shell: a ball with spiral waves on it. */
function shellShape(): { normals: Float32Array; albedo: Uint8Array } {
  const normals = new Float32Array(3 * SIDE * SIDE);
  const albedo = new Uint8Array(4 * SIDE * SIDE);
  const height = (x: number, y: number) => {
    const square = x * x + y * y;
    if (square >= 1) return Number.NaN;
    const wave = Math.cos(7 * Math.atan2(y, x) + 9 * Math.sqrt(square));
    return Math.sqrt(1 - square) + 0.05 * wave * square * (1 - square) * 4;
  };
  for (let row = 0; row < SIDE; row++) {
    for (let column = 0; column < SIDE; column++) {
      const x = ((column + 0.5) / SIDE - 0.5) / 0.44;
      const y = (0.5 - (row + 0.5) / SIDE) / 0.44;
      const step = 1e-3;
      const [here, right, up] = [height(x, y), height(x + step, y), height(x, y + step)];
      const [a, b] = [(here - right) / step, (here - up) / step];
      if (Number.isNaN(a) || Number.isNaN(b)) continue;
      const pixel = row * SIDE + column;
      const length = Math.hypot(a, b, 1);
      normals.set([a / length, b / length, 1 / length], 3 * pixel);
      albedo.set([233, 214, 196, 255], 4 * pixel);
    }
  }
  return { normals, albedo };
}
