import { context, paint } from "../dom.js";
import { texts } from "../texts/texts.js";
import type { Place, Size } from "./view.js";

/** One of the numbers that a map holds at every pixel. */
export interface Channel {
  readonly name: string;
  /** A CSS colour. */
  readonly colour: string;
  /** Its value at a pixel; not a number outside the object. */
  at(pixel: number): number;
}

/** What the viewer shows of a map. */
export interface Picture extends Size {
  readonly channels: readonly Channel[];
  /** From and to which value the histogram goes. */
  readonly range: readonly [number, number];
  /** Draws it so that it fills a place on a canvas; only what lies within the clip needs to be drawn. */
  draw(drawing: CanvasRenderingContext2D, place: Place, clip: Place): void;
  /** The values at a pixel, in words. */
  words(pixel: number): string;
}

/** What a picture knows beside its pixels. */
export type Values = Pick<Picture, "channels" | "range" | "words">;

/** A picture of pixels that do not change. */
export class Still implements Picture {
  readonly channels: readonly Channel[];
  readonly range: readonly [number, number];
  readonly words: (pixel: number) => string;
  readonly #canvas = document.createElement("canvas");

  constructor(
    readonly width: number,
    readonly height: number,
    rgba: Uint8Array<ArrayBuffer>,
    { channels, range, words }: Values,
  ) {
    this.channels = channels;
    this.range = range;
    this.words = words;
    paint(this.#canvas, width, height, rgba);
  }

  draw(drawing: CanvasRenderingContext2D, place: Place): void {
    drawScaled(drawing, this.#canvas, place);
  }
}

/** Draws a canvas into a place: smooth where it gets smaller, as clear squares where pixels get large. */
export function drawScaled(
  drawing: CanvasRenderingContext2D,
  picture: HTMLCanvasElement,
  place: Place,
): void {
  drawing.imageSmoothingEnabled = place.width < 4 * picture.width;
  drawing.imageSmoothingQuality = "medium";
  drawing.drawImage(picture, place.left, place.top, place.width, place.height);
}

/** Red, green and blue of 8-bit RGBA; transparent pixels have no values. */
export function codes(rgba: Uint8Array): readonly Channel[] {
  const channel = (name: string, colour: string, index: number): Channel => ({
    name,
    colour,
    at: (pixel) => (rgba[4 * pixel + 3] === 0 ? Number.NaN : (rgba[4 * pixel + index] ?? Number.NaN)),
  });
  return [
    channel(texts.viewer.red, RED, 0),
    channel(texts.viewer.green, GREEN, 1),
    channel(texts.viewer.blue, BLUE, 2),
  ];
}

export const RED = "#ff6b7a";
export const GREEN = "#5fdc9f";
export const BLUE = "#7aa2ff";
export const WHITE = "#e8e8f6";

/** A canvas of its own, cleared. */
export function cleared(canvas: HTMLCanvasElement, { width, height }: Size): CanvasRenderingContext2D {
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const drawing = context(canvas);
  drawing.clearRect(0, 0, width, height);
  return drawing;
}
