import { make } from "../dom.js";
import { texts } from "../texts/texts.js";
import type { MaskDocument } from "./document.js";
import { Guides } from "./guides.js";
import type { Place } from "./shapes.js";
import { INSIDE } from "./tiles.js";
import type { MaskView } from "./view.js";

export type Tool = "brush" | "eraser" | "polygon" | "cut" | "move";

/** CSS pixels from a polygon's first corner at which a click closes it. */
const CLOSING = 12;
/** CSS pixels that an arrow key moves the brush. */
const STEP = 8;

/** What the pointer is doing. */
type Doing =
  | { readonly kind: "stroke"; readonly value: number; last: Place }
  | { readonly kind: "pan"; x: number; y: number }
  | { readonly kind: "pinch" };

const PLACE_OF_KEY: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** Pointer, pen, fingers and keys on the photograph. */
export class MaskStage {
  readonly element = make("div", "mask-stage");
  readonly #document: MaskDocument;
  readonly #view: MaskView;
  readonly #guides = new Guides();
  readonly #fingers = new Map<number, PointerEvent>();
  #tool: Tool = "brush";
  /** Of the brush, in pixels of the photograph. */
  #radius = 10;
  #doing: Doing | undefined;
  #corners: Place[] = [];
  #cursor: Place;
  /** Nothing is painted while something heavy is done. */
  locked = false;

  constructor(maskDocument: MaskDocument, view: MaskView) {
    this.#document = maskDocument;
    this.#view = view;
    this.#cursor = view.middle;
    const { element } = this;
    element.tabIndex = 0;
    element.setAttribute("role", "application");
    element.setAttribute("aria-label", texts.mask.stage);
    element.append(view.element, this.#guides.element);
    element.addEventListener("pointerdown", (event) => this.#down(event));
    element.addEventListener("pointermove", (event) => this.#move(event));
    for (const end of ["pointerup", "pointercancel"] as const)
      element.addEventListener(end, (event) => this.#up(event));
    element.addEventListener("pointerleave", () => this.#guides.hideBrush());
    element.addEventListener("dblclick", () => this.#close());
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    element.addEventListener("keydown", (event) => this.#key(event));
    element.addEventListener("keyup", ({ key }) => key === " " && this.#end());
  }

  set tool(tool: Tool) {
    this.#tool = tool;
    this.element.dataset.tool = tool;
    this.dropPolygon();
    this.draw();
  }

  set radius(radius: number) {
    this.#radius = radius;
    this.draw();
  }

  /** Gives up a polygon that is not closed; whether there was one. */
  dropPolygon(): boolean {
    const had = this.#corners.length > 0;
    this.#corners = [];
    this.draw();
    return had;
  }

  /** Draws brush and corners where they are now. */
  draw(): void {
    const screen = (place: Place) => this.#view.screenOf(place);
    const painting = this.#tool === "brush" || this.#tool === "eraser";
    this.#guides.brush(screen(this.#cursor), painting ? this.#radius * this.#view.scale : 0);
    this.#guides.polygon(this.#corners.map(screen), screen(this.#cursor));
  }

  #down(event: PointerEvent): void {
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    this.#cursor = this.#view.placeAt(event.clientX, event.clientY);
    if (event.pointerType === "touch") {
      this.#fingers.set(event.pointerId, event);
      if (this.#fingers.size === 2) this.#pinch();
      if (this.#fingers.size > 1) return;
    }
    if (event.button === 1 || this.#tool === "move")
      this.#doing = { kind: "pan", x: event.clientX, y: event.clientY };
    else if (this.locked) return;
    else if (this.#tool === "brush" || this.#tool === "eraser")
      this.#begin(erases(event), radiusOf(event, this.#radius));
    else if (event.button === 0) this.#corner();
    this.draw();
  }

  #move(event: PointerEvent): void {
    const doing = this.#doing;
    if (doing?.kind === "pinch") {
      this.#spread(event);
    } else if (doing?.kind === "pan") {
      this.#view.pan(event.clientX - doing.x, event.clientY - doing.y);
      [doing.x, doing.y] = [event.clientX, event.clientY];
    } else if (doing?.kind === "stroke") {
      // A browser that draws slowly hands over what came in between.
      const all = event.getCoalescedEvents?.() ?? [];
      for (const one of all.length > 0 ? all : [event])
        this.#paintTo(this.#view.placeAt(one.clientX, one.clientY), radiusOf(one, this.#radius));
    }
    this.#cursor = this.#view.placeAt(event.clientX, event.clientY);
    this.draw();
  }

  #up(event: PointerEvent): void {
    this.#fingers.delete(event.pointerId);
    if (this.#doing?.kind === "pinch" && this.#fingers.size > 0) return;
    this.#end();
  }

  #begin(erase: boolean, radius: number): void {
    const value = erase === (this.#tool === "brush") ? 0 : INSIDE;
    this.#doing = { kind: "stroke", value, last: this.#cursor };
    this.#paintTo(this.#cursor, radius);
  }

  #paintTo(place: Place, radius: number): void {
    if (this.#doing?.kind !== "stroke") return;
    this.#document.stroke(this.#doing.last, place, radius, this.#doing.value);
    this.#doing.last = place;
  }

  #end(): void {
    if (this.#doing?.kind === "stroke") this.#document.commit();
    this.#doing = undefined;
  }

  /** A second finger came: the first did not want to paint. */
  #pinch(): void {
    const stroke = this.#doing?.kind === "stroke";
    this.#doing = { kind: "pinch" };
    if (!stroke) return;
    if (this.#document.history.commit()) this.#document.history.drop();
    this.#document.repaint();
  }

  #spread(event: PointerEvent): void {
    const before = this.#fingers.get(event.pointerId);
    const other = [...this.#fingers.values()].find(({ pointerId }) => pointerId !== event.pointerId);
    if (!before || !other) return;
    this.#fingers.set(event.pointerId, event);
    const distance = (one: PointerEvent) =>
      Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
    const middle = [(event.clientX + other.clientX) / 2, (event.clientY + other.clientY) / 2] as const;
    // One finger moves at a time: the middle between both moves half as far.
    this.#view.pan((event.clientX - before.clientX) / 2, (event.clientY - before.clientY) / 2);
    this.#view.zoom(distance(event) / Math.max(distance(before), 1), ...middle);
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    // Lines and pages instead of pixels; a pinch on a touchpad comes as a wheel with Ctrl, in small steps.
    const unit = event.deltaMode === 0 ? 1 : 30;
    this.#view.zoom(
      Math.exp(-event.deltaY * unit * (event.ctrlKey ? 0.01 : 0.0018)),
      event.clientX,
      event.clientY,
    );
  }

  #corner(): void {
    const [first] = this.#corners;
    if (first && this.#corners.length > 2) {
      const [a, b] = [this.#view.screenOf(first), this.#view.screenOf(this.#cursor)];
      if (Math.hypot(a.x - b.x, a.y - b.y) < CLOSING) {
        this.#close();
        return;
      }
    }
    this.#corners.push(this.#cursor);
  }

  #close(): void {
    const corners = this.#corners;
    this.#corners = [];
    if (corners.length > 2 && !this.locked)
      this.#document.polygon(corners, this.#tool === "cut" ? 0 : INSIDE);
    this.draw();
  }

  #key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey) return;
    const towards = PLACE_OF_KEY[event.key];
    if (towards) this.#arrow(towards, event);
    else if (event.key === " " && !event.repeat) this.#space();
    else if (event.key === "Enter") this.#close();
    else if (event.key === "Backspace") this.#corners.pop();
    else return;
    event.preventDefault();
    this.draw();
  }

  #arrow([x, y]: readonly [number, number], { shiftKey, altKey }: KeyboardEvent): void {
    if (altKey || this.#tool === "move") {
      this.#view.pan(-x * 6 * STEP, -y * 6 * STEP);
      return;
    }
    const step = shiftKey ? 1 : STEP / this.#view.scale;
    const { width, height } = this.#document.tiles;
    this.#cursor = {
      x: Math.min(Math.max(this.#cursor.x + x * step, 0), width),
      y: Math.min(Math.max(this.#cursor.y + y * step, 0), height),
    };
    this.#paintTo(this.#cursor, this.#radius);
  }

  #space(): void {
    if (this.locked || this.#tool === "move") return;
    if (this.#tool === "brush" || this.#tool === "eraser") this.#begin(false, this.#radius);
    else this.#corner();
  }
}

/** Whether a press is meant to erase: the right button, or the other end of a pen. */
function erases({ button, buttons }: PointerEvent): boolean {
  return button === 2 || (buttons & 32) !== 0;
}

/** A pen that is pressed lightly paints a thinner line. */
function radiusOf({ pointerType, pressure }: PointerEvent, radius: number): number {
  return pointerType === "pen" && pressure > 0 ? radius * (0.3 + 0.7 * pressure) : radius;
}
