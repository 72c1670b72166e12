import { byId, make, write } from "../dom.js";
import { texts } from "../texts/texts.js";
import { Choice, type Layer } from "./choice.js";
import { type Asked, listen, STEP } from "./gestures.js";
import { drawHistogram } from "./histogram.js";
import { cleared } from "./picture.js";
import { type Known, readout } from "./readout.js";
import { Split } from "./split.js";
import { fit, isFit, pan, placeOf, resized, type Size, toFrame, type View, zoom } from "./view.js";

/** What the viewer needs of the relighting. */
export interface LampHook {
  /** The lamp goes to a place in the unit circle, y up. */
  lampTo(x: number, y: number): void;
  lampBy(right: number, up: number): void;
  /** A drawing begins. */
  begin(): void;
  /** Where the lamps are. */
  readonly places: readonly { readonly x: number; readonly y: number }[];
}

/** Milliseconds without a change after which the histogram is drawn anew. */
const PAUSE = 120;

/** One picture of all maps: enlarged, moved, compared, and read pixel by pixel. */
export class Viewer {
  readonly #figure = byId("viewer");
  readonly #canvas = byId<HTMLCanvasElement>("viewer-canvas");
  readonly #values = byId("viewer-values");
  readonly #histogram = byId<HTMLCanvasElement>("viewer-histogram");
  readonly #spread = byId("viewer-spread");
  readonly #percent = byId("viewer-percent");
  readonly #lampSwitch = byId<HTMLButtonElement>("viewer-lamp");
  readonly #main = new Choice(byId("viewer-map"), byId("viewer-status"), undefined, () => this.#changed());
  readonly #other = new Choice(byId("viewer-other"), byId("viewer-status"), texts.viewer.nothing, () =>
    this.#changed(),
  );
  readonly #split = new Split(byId("viewer-split"), () => this.refresh());
  #frame: Size = { width: 1, height: 1 };
  #size: Size = { width: 0, height: 0 };
  #view: View = { x: 0, y: 0, scale: 1 };
  #known: Known | undefined;
  /** The pointer, in pixels of the canvas. */
  #pointer: readonly [number, number] | undefined;
  #drawing = false;
  #counting: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly lamp: LampHook) {
    listen(this.#canvas, this.#asked());
    const { zoom: larger, fit: whole, actual, fullScreen } = this.#asked();
    byId("viewer-in").addEventListener("click", () => larger(STEP));
    byId("viewer-out").addEventListener("click", () => larger(1 / STEP));
    byId("viewer-fit").addEventListener("click", whole);
    byId("viewer-actual").addEventListener("click", actual);
    const full = byId<HTMLButtonElement>("viewer-full");
    full.hidden = !document.fullscreenEnabled;
    full.addEventListener("click", fullScreen);
    document.addEventListener("fullscreenchange", () => {
      full.textContent = document.fullscreenElement ? texts.viewer.leaveFullScreen : texts.viewer.fullScreen;
    });
    this.#lampSwitch.addEventListener("click", () => {
      this.#lampSwitch.setAttribute("aria-pressed", String(!this.#movesLamp));
      this.refresh();
    });
    for (const event of ["focus", "blur"]) this.#canvas.addEventListener(event, () => this.refresh());
    new ResizeObserver(() => this.#resize()).observe(this.#canvas);
  }

  /** The names of the shown maps: the one, and the one beside it, if any. */
  get chosen(): readonly [string, string] {
    return [this.#main.id, this.#other.id];
  }

  /** Takes another result: its maps, the size they are laid over, and what is known at its pixels. */
  show(layers: readonly Layer[], frame: Size, known: Known, chosen: string): void {
    this.#frame = frame;
    this.#view = fit(frame, this.#size);
    this.offer(layers, known, chosen, "");
  }

  /** The maps of the same result have changed. */
  offer(layers: readonly Layer[], known: Known, chosen = this.#main.id, other = this.#other.id): void {
    this.#known = known;
    this.#main.offer(layers, chosen);
    this.#other.offer(layers, other);
  }

  /** Shows these maps. */
  choose(main: string, other: string): void {
    if (this.#main.id !== main) this.#main.choose(main);
    if (this.#other.id !== other) this.#other.choose(other);
  }

  /** Draws soon, once for however many changes. */
  refresh(): void {
    if (this.#drawing) return;
    this.#drawing = true;
    requestAnimationFrame(() => {
      this.#drawing = false;
      this.#draw();
    });
  }

  /** Whether the relit object is seen, and dragging moves its lamp. */
  get #movesLamp(): boolean {
    return this.#relit && this.#lampSwitch.getAttribute("aria-pressed") === "true";
  }

  get #relit(): boolean {
    return this.chosen.includes("relit");
  }

  #changed(): void {
    this.#lampSwitch.hidden = !this.#relit;
    this.#split.show(this.#other.picture !== undefined, this.#main.name, this.#other.name);
    const other = this.#other.picture ? this.#other.name : undefined;
    this.#canvas.setAttribute("aria-label", texts.viewer.shown(this.#main.name, other));
    this.refresh();
  }

  /** The canvas has as many pixels as the screen has under it. */
  #resize(): void {
    const { clientWidth, clientHeight } = this.#canvas;
    const [width, height] = [clientWidth, clientHeight].map((side) => Math.round(side * devicePixelRatio));
    const size = { width: width ?? 0, height: height ?? 0 };
    if (size.width === 0 || size.height === 0) return;
    this.#view = resized(this.#view, this.#frame, this.#size, size);
    this.#size = size;
    // At once: a canvas of a new size is empty until it is drawn.
    this.#draw();
  }

  #draw(): void {
    if (this.#size.width === 0) return;
    this.lamp.begin();
    const drawing = cleared(this.#canvas, this.#size);
    const place = placeOf(this.#view, this.#frame, this.#size);
    const middle = this.#other.picture ? Math.round(this.#split.at * this.#size.width) : this.#size.width;
    this.#part(drawing, this.#main, 0, middle, place);
    this.#part(drawing, this.#other, middle, this.#size.width, place);
    if (this.#movesLamp) for (const { x, y } of this.lamp.places) glow(drawing, this.#size, x, y);
    if (this.#canvas.matches(":focus-visible")) crosshair(drawing, this.#size);
    write(this.#percent, texts.viewer.scale(Math.round(100 * this.#view.scale)));
    // Where the whole is seen, a finger scrolls the page.
    const scrolls = !this.#movesLamp && isFit(this.#view, this.#frame, this.#size);
    this.#canvas.dataset.drag = this.#movesLamp ? "lamp" : scrolls ? "page" : "picture";
    this.#read();
    clearTimeout(this.#counting);
    this.#counting = setTimeout(() => this.#count(), PAUSE);
  }

  #part(
    drawing: CanvasRenderingContext2D,
    { picture }: Choice,
    from: number,
    to: number,
    place: ReturnType<typeof placeOf>,
  ): void {
    if (!picture || to <= from) return;
    const clip = { left: from, top: 0, width: to - from, height: this.#size.height };
    drawing.save();
    drawing.beginPath();
    drawing.rect(clip.left, clip.top, clip.width, clip.height);
    drawing.clip();
    picture.draw(drawing, place, clip);
    drawing.restore();
  }

  /** Says what is under the pointer; for keys, what is in the middle. */
  #read(): void {
    const keys = this.#canvas.matches(":focus-visible");
    const at = this.#pointer ?? (keys ? [this.#size.width / 2, this.#size.height / 2] : undefined);
    const pairs = at && this.#known ? this.#wordsAt(...(at as [number, number]), this.#known) : [];
    const nothing: [string, string][] = [["", texts.viewer.point]];
    const shown = pairs.length > 0 ? pairs : nothing;
    // In place: this follows every move of the pointer.
    while (this.#values.children.length > shown.length) this.#values.lastElementChild?.remove();
    while (this.#values.children.length < shown.length)
      this.#values.append(make("div", "", make("dt"), make("dd")));
    for (const [index, row] of [...this.#values.children].entries()) {
      const [name, words] = shown[index] ?? ["", ""];
      write(row.firstElementChild as HTMLElement, name || texts.viewer.values);
      write(row.lastElementChild as HTMLElement, words);
    }
    this.#values.classList.toggle("none", pairs.length === 0);
  }

  #wordsAt(left: number, top: number, known: Known): [string, string][] {
    const [x, y] = toFrame(this.#view, this.#size, left, top);
    const pairs = readout(known, Math.floor(x), Math.floor(y));
    if (pairs.length < 3) return pairs;
    for (const { id, name, picture } of [this.#main, this.#other]) {
      // What every map's read-out already says.
      if (!picture || ["normals", "albedo", "depth"].includes(id)) continue;
      const column = Math.floor((x / this.#frame.width) * picture.width);
      const row = Math.floor((y / this.#frame.height) * picture.height);
      pairs.push([name, picture.words(row * picture.width + column)]);
    }
    return pairs;
  }

  #count(): void {
    const { picture } = this.#main;
    const words = picture ? drawHistogram(this.#histogram, picture) : "";
    this.#spread.textContent = words;
    this.#histogram.setAttribute("aria-label", texts.viewer.histogram(this.#main.name));
  }

  #asked(): Asked {
    const change = (view: View) => {
      this.#view = view;
      this.refresh();
    };
    const ratio = () => this.#size.width / Math.max(this.#canvas.clientWidth, 1);
    const movesLamp = () => this.#movesLamp;
    return {
      zoom: (factor, left, top) => {
        const point = [left, top].map((value) => (value === undefined ? undefined : value * ratio()));
        change(zoom(this.#view, this.#frame, this.#size, factor, point[0], point[1]));
      },
      pan: (right, down) => change(pan(this.#view, this.#frame, right * ratio(), down * ratio())),
      fit: () => change(fit(this.#frame, this.#size)),
      actual: () => change(zoom(this.#view, this.#frame, this.#size, 1 / this.#view.scale)),
      fullScreen: () => {
        if (document.fullscreenElement) void document.exitFullscreen();
        else void this.#figure.requestFullscreen();
      },
      point: (at) => {
        this.#pointer = at && [at[0] * ratio(), at[1] * ratio()];
        this.#read();
      },
      get lamp() {
        return movesLamp();
      },
      lampTo: (left, top) => {
        const { clientWidth, clientHeight } = this.#canvas;
        const radius = Math.min(clientWidth, clientHeight) / 2;
        this.lamp.lampTo((left - clientWidth / 2) / radius, (clientHeight / 2 - top) / radius);
      },
      lampBy: (right, up) => this.lamp.lampBy(right, up),
    };
  }
}

/** Marks the place of a lamp. */
function glow(drawing: CanvasRenderingContext2D, { width, height }: Size, x: number, y: number): void {
  const radius = Math.min(width, height) / 2;
  drawing.beginPath();
  drawing.arc(width / 2 + radius * x, height / 2 - radius * y, 7, 0, 2 * Math.PI);
  drawing.fillStyle = "#fff6d5";
  drawing.fill();
  drawing.strokeStyle = "rgb(20 20 40 / 70%)";
  drawing.lineWidth = 2;
  drawing.stroke();
}

/** Marks the middle, whose values keys read. */
function crosshair(drawing: CanvasRenderingContext2D, { width, height }: Size): void {
  const [x, y] = [Math.floor(width / 2), Math.floor(height / 2)];
  for (const [colour, thick] of [
    ["#000", 3],
    ["#fff", 1],
  ] as const) {
    drawing.strokeStyle = colour;
    drawing.lineWidth = thick;
    drawing.beginPath();
    drawing.moveTo(x - 12.5, y + 0.5);
    drawing.lineTo(x + 13.5, y + 0.5);
    drawing.moveTo(x + 0.5, y - 12.5);
    drawing.lineTo(x + 0.5, y + 13.5);
    drawing.stroke();
  }
}
