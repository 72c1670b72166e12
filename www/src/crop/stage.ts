import { make } from "../dom.js";
import { texts } from "../texts/texts.js";
import { between, type Crop, type Frame, moved, resized, type Sides, wholeOf } from "./rectangle.js";

/** Handles at corners and sides: those of corners are last, above the others. */
const HANDLES: readonly Sides[] = [
  { x: 0, y: -1 },
  { x: -1, y: 0 },
  { x: 1, y: 0 },
  { x: 0, y: 1 },
  { x: -1, y: -1 },
  { x: 1, y: -1 },
  { x: -1, y: 1 },
  { x: 1, y: 1 },
];

/** Parts of the longer side that an arrow key moves by. */
const STEPS = 100;

const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** A place on the photograph, in pixels. */
interface Place {
  readonly x: number;
  readonly y: number;
}

/** A photograph, and the rectangle on it that is drawn, moved and stretched. */
export class CropStage {
  readonly element = make("div", "crop-stage");
  /** What has the keys. */
  readonly box = make("div", "crop-box");
  readonly #place: HTMLElement;
  readonly #observer = new ResizeObserver(() => this.#fit());
  #crop: Crop;

  /** @param changed hears of another rectangle */
  constructor(
    picture: HTMLCanvasElement,
    private readonly frame: Frame,
    private readonly changed: (crop: Crop) => void,
  ) {
    this.#crop = wholeOf(frame);
    for (const { x, y } of HANDLES) {
      const handle = make("span", "handle");
      Object.assign(handle.dataset, { x, y });
      this.box.append(handle);
    }
    this.box.tabIndex = 0;
    this.box.setAttribute("role", "application");
    this.box.setAttribute("aria-roledescription", texts.crop.kind);
    this.box.setAttribute("aria-label", texts.crop.box);
    this.box.addEventListener("keydown", (event) => this.#key(event));
    this.#place = make("div", "crop-place", picture, this.box);
    this.element.append(this.#place);
    this.element.addEventListener("pointerdown", (event) => this.#press(event));
    this.#observer.observe(this.element);
  }

  set crop(crop: Crop) {
    this.#crop = crop;
    const percent = (part: number, whole: number) => `${(100 * part) / whole}%`;
    Object.assign(this.box.style, {
      left: percent(crop.left, this.frame.width),
      top: percent(crop.top, this.frame.height),
      width: percent(crop.width, this.frame.width),
      height: percent(crop.height, this.frame.height),
    });
  }

  close(): void {
    this.#observer.disconnect();
  }

  /** The photograph as large as there is room. */
  #fit(): void {
    const { clientWidth, clientHeight } = this.element;
    const { width, height } = this.frame;
    // Room for the handles at its border.
    const scale = Math.max(Math.min((clientWidth - 36) / width, (clientHeight - 36) / height), 0);
    this.#place.style.width = `${scale * width}px`;
    this.#place.style.height = `${scale * height}px`;
  }

  #placeOf({ clientX, clientY }: PointerEvent): Place {
    const { left, top, width, height } = this.#place.getBoundingClientRect();
    const { frame } = this;
    return { x: ((clientX - left) / width) * frame.width, y: ((clientY - top) / height) * frame.height };
  }

  /** A handle stretches the rectangle, the inside moves it, and elsewhere a new one begins. */
  #press(event: PointerEvent): void {
    if (event.button !== 0 || !event.isPrimary) return;
    event.preventDefault();
    this.box.focus({ preventScroll: true });
    const [start, crop] = [this.#placeOf(event), this.#crop];
    const { target } = event;
    const handle = target instanceof HTMLElement && target.matches(".handle") ? target.dataset : undefined;
    const sides = handle && ({ x: Number(handle.x), y: Number(handle.y) } as Sides);
    const inside = this.box.contains(target as Node);
    const drag = (move: PointerEvent) => {
      if (move.pointerId !== event.pointerId) return;
      const at = this.#placeOf(move);
      const [x, y] = [at.x - start.x, at.y - start.y];
      if (sides) this.#change(resized(crop, sides, x, y, this.frame));
      else if (inside) this.#change(moved(crop, x, y, this.frame));
      else this.#change(between(start, at, this.frame));
    };
    const end = (last: PointerEvent) => {
      if (last.pointerId !== event.pointerId) return;
      this.element.removeEventListener("pointermove", drag);
      for (const name of ["pointerup", "pointercancel"] as const) this.element.removeEventListener(name, end);
    };
    this.element.setPointerCapture(event.pointerId);
    this.element.addEventListener("pointermove", drag);
    for (const name of ["pointerup", "pointercancel"] as const) this.element.addEventListener(name, end);
  }

  #key(event: KeyboardEvent): void {
    const arrow = ARROWS[event.key];
    if (!arrow || event.altKey || event.metaKey) return;
    event.preventDefault();
    const { width, height } = this.frame;
    const step = event.ctrlKey ? 1 : Math.max(Math.round(Math.max(width, height) / STEPS), 1);
    const [x, y] = [step * arrow[0], step * arrow[1]];
    if (event.shiftKey) this.#change(resized(this.#crop, { x: 1, y: 1 }, x, y, this.frame));
    else this.#change(moved(this.#crop, x, y, this.frame));
  }

  #change(crop: Crop): void {
    this.crop = crop;
    this.changed(crop);
  }
}
