import { context, make } from "../dom.js";
import type { Picture } from "./protocol.js";
import type { Box, Place } from "./shapes.js";
import { TILE, type Tiles } from "./tiles.js";

/** Pixels of RGBA as numbers, alpha first. */
const OUTSIDE = 0x8c_85_2f_b8;
const EDGE = 0xff_9f_dc_5f;

/** Largest size of a pixel on the screen. */
const CLOSEST = 40;

/** The photograph and the mask over it, at any size; only what has changed is drawn again. */
export class MaskView {
  readonly element = make("div", "mask-view");
  readonly #picture = make("canvas");
  readonly #overlay = make("canvas");
  readonly #tiles: Tiles;
  readonly #onView: () => void;
  #shown: Picture;
  /** Screen pixels of a pixel of the photograph, and where its corner is. */
  #scale = 1;
  #left = 0;
  #top = 0;
  #fitted = true;
  /** What must be drawn in the next frame. */
  #dirty: Box | "all" | undefined;
  #wholeView = false;
  readonly #observer = new ResizeObserver(() => this.#resize());

  /** @param onView hears that another part is shown, or at another size */
  constructor(tiles: Tiles, picture: Picture, onView: () => void) {
    this.#tiles = tiles;
    this.#shown = picture;
    this.#onView = onView;
    this.element.append(this.#picture, this.#overlay);
    this.#observer.observe(this.element);
  }

  close(): void {
    this.#observer.disconnect();
  }

  /** Shows another photograph of the same frame. */
  show(picture: Picture): void {
    for (const level of this.#shown.levels) level.close();
    this.#shown = picture;
    this.#all();
  }

  lighten(lightened: boolean): void {
    this.#picture.classList.toggle("lightened", lightened);
  }

  get scale(): number {
    return this.#scale / devicePixelRatio;
  }

  /** A place on the screen as one on the photograph. */
  placeAt(clientX: number, clientY: number): Place {
    const { left, top } = this.element.getBoundingClientRect();
    return this.#placeAt((clientX - left) * devicePixelRatio, (clientY - top) * devicePixelRatio);
  }

  /** A place on the photograph as one in the element, in CSS pixels. */
  screenOf({ x, y }: Place): Place {
    return {
      x: (this.#left + x * this.#scale) / devicePixelRatio,
      y: (this.#top + y * this.#scale) / devicePixelRatio,
    };
  }

  /** The place in the middle of what is shown. */
  get middle(): Place {
    return this.#placeAt(this.#picture.width / 2, this.#picture.height / 2);
  }

  /** Shows the whole photograph. */
  fit(): void {
    const { width, height } = this.#picture;
    const scale = Math.min(width / this.#tiles.width, height / this.#tiles.height) * 0.96;
    this.#scale = Math.max(scale, 1e-4);
    this.#left = (width - this.#scale * this.#tiles.width) / 2;
    this.#top = (height - this.#scale * this.#tiles.height) / 2;
    this.#fitted = true;
    this.#all();
  }

  /** Changes the size, and keeps a place of the screen where it is; the middle when none is given. */
  zoom(factor: number, clientX?: number, clientY?: number): void {
    const box = this.element.getBoundingClientRect();
    const x = ((clientX ?? box.left + box.width / 2) - box.left) * devicePixelRatio;
    const y = ((clientY ?? box.top + box.height / 2) - box.top) * devicePixelRatio;
    const smallest = 16 / Math.max(this.#tiles.width, this.#tiles.height);
    const scale = Math.min(Math.max(this.#scale * factor, smallest), CLOSEST * devicePixelRatio);
    this.#left = x - ((x - this.#left) * scale) / this.#scale;
    this.#top = y - ((y - this.#top) * scale) / this.#scale;
    this.#scale = scale;
    this.#fitted = false;
    this.#all();
  }

  /** Moves the photograph by CSS pixels. */
  pan(x: number, y: number): void {
    this.#left += x * devicePixelRatio;
    this.#top += y * devicePixelRatio;
    this.#fitted = false;
    this.#all();
  }

  /** The mask has changed in a part of the frame, or anywhere. */
  changed(box?: Box): void {
    const before = this.#dirty;
    if (before === undefined) requestAnimationFrame(() => this.#draw());
    if (box === undefined || before === "all") this.#dirty = "all";
    else if (before === undefined) this.#dirty = box;
    else
      this.#dirty = {
        left: Math.min(before.left, box.left),
        top: Math.min(before.top, box.top),
        right: Math.max(before.right, box.right),
        bottom: Math.max(before.bottom, box.bottom),
      };
  }

  #all(): void {
    this.#wholeView = true;
    this.changed();
  }

  #placeAt(x: number, y: number): Place {
    return { x: (x - this.#left) / this.#scale, y: (y - this.#top) / this.#scale };
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.element;
    for (const canvas of [this.#picture, this.#overlay]) {
      canvas.width = Math.max(Math.round(clientWidth * devicePixelRatio), 1);
      canvas.height = Math.max(Math.round(clientHeight * devicePixelRatio), 1);
    }
    if (this.#fitted) this.fit();
    else this.#all();
  }

  #draw(): void {
    const dirty = this.#dirty;
    this.#dirty = undefined;
    if (this.#wholeView) {
      this.#wholeView = false;
      this.#drawPicture();
      this.#onView();
    }
    const { width, height } = this.#overlay;
    if (dirty === "all" || dirty === undefined) {
      this.#drawMask(0, 0, width, height);
      return;
    }
    // One pixel more on each side, for the edge that is drawn between pixels.
    const left = Math.max(Math.floor(this.#left + (dirty.left - 1) * this.#scale) - 1, 0);
    const top = Math.max(Math.floor(this.#top + (dirty.top - 1) * this.#scale) - 1, 0);
    const right = Math.min(Math.ceil(this.#left + (dirty.right + 1) * this.#scale) + 1, width);
    const bottom = Math.min(Math.ceil(this.#top + (dirty.bottom + 1) * this.#scale) + 1, height);
    if (right > left && bottom > top) this.#drawMask(left, top, right, bottom);
  }

  #drawPicture(): void {
    const canvas = this.#picture;
    const drawing = context(canvas);
    drawing.clearRect(0, 0, canvas.width, canvas.height);
    const { width, height, levels } = this.#shown;
    // The smallest level that still has a pixel for each of the screen.
    const level = levels.findLast((picture) => picture.width >= width * this.#scale) ?? levels[0];
    if (level === undefined) return;
    drawing.imageSmoothingEnabled = this.#scale < 3;
    const [first, last] = [this.#placeAt(0, 0), this.#placeAt(canvas.width, canvas.height)];
    const [left, top] = [Math.max(first.x, 0), Math.max(first.y, 0)];
    const [wide, high] = [Math.min(last.x, width) - left, Math.min(last.y, height) - top];
    if (wide <= 0 || high <= 0) return;
    const share = level.width / width;
    drawing.drawImage(
      level,
      left * share,
      top * share,
      wide * share,
      high * share,
      this.#left + left * this.#scale,
      this.#top + top * this.#scale,
      wide * this.#scale,
      high * this.#scale,
    );
  }

  /** Draws the mask on a part of the screen: one look into the tiles for each of its pixels. */
  #drawMask(left: number, top: number, right: number, bottom: number): void {
    const tiles = this.#tiles;
    const wide = right - left;
    const pixels = new Uint32Array(wide * (bottom - top));
    const columns = Int32Array.from({ length: wide + 1 }, (_, at) =>
      Math.floor((left + at - 0.5 - this.#left) / this.#scale),
    );
    let above = new Uint8Array(wide + 1);
    let row = new Uint8Array(wide + 1);
    for (let y = top - 1; y < bottom; y++) {
      const on = Math.floor((y + 0.5 - this.#top) / this.#scale);
      [above, row] = [row, above];
      if (on < 0 || on >= tiles.height) {
        row.fill(0);
        continue;
      }
      const [tileRow, inTile] = [Math.floor(on / TILE) * tiles.columns, (on % TILE) * TILE];
      const start = (y - top) * wide - 1;
      for (let at = 0; at <= wide; at++) {
        const x = columns[at] ?? -1;
        const framed = x >= 0 && x < tiles.width;
        const value = framed ? (tiles.tile(tileRow + Math.floor(x / TILE))[inTile + (x % TILE)] ?? 0) : 0;
        row[at] = value;
        if (!framed || y < top || at === 0) continue;
        if (value === 0) pixels[start + at] = row[at - 1] !== 0 || above[at] !== 0 ? EDGE : OUTSIDE;
        else if (row[at - 1] === 0 || above[at] === 0) pixels[start + at] = EDGE;
      }
    }
    const drawn = new ImageData(new Uint8ClampedArray(pixels.buffer), wide, bottom - top);
    context(this.#overlay).putImageData(drawn, left, top);
  }
}
