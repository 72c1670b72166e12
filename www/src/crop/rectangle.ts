/** The size of a photograph in pixels. */
export interface Frame {
  readonly width: number;
  readonly height: number;
}

/** The part of all photographs that is taken, in pixels of the whole ones. */
export interface Crop extends Frame {
  readonly left: number;
  readonly top: number;
}

/** Which sides of a rectangle are moved: -1 the left or upper one, 1 the right or lower one. */
export interface Sides {
  readonly x: -1 | 0 | 1;
  readonly y: -1 | 0 | 1;
}

/** Shortest side: in less there is hardly an object. */
export const SHORTEST = 16;

/** All of a photograph. */
export function wholeOf({ width, height }: Frame): Crop {
  return { left: 0, top: 0, width, height };
}

/** Whether a rectangle leaves nothing out. */
export function isWhole({ left, top, width, height }: Crop, frame: Frame): boolean {
  return left === 0 && top === 0 && width === frame.width && height === frame.height;
}

/** The nearest rectangle of whole pixels that lies in the frame and is not too small. */
export function fitted(crop: Crop, frame: Frame): Crop {
  const side = (length: number, whole: number) =>
    within(Math.round(length), Math.min(SHORTEST, whole), whole);
  const [width, height] = [side(crop.width, frame.width), side(crop.height, frame.height)];
  return {
    left: within(Math.round(crop.left), 0, frame.width - width),
    top: within(Math.round(crop.top), 0, frame.height - height),
    width,
    height,
  };
}

/** A rectangle of the same size elsewhere, within the frame. */
export function moved(crop: Crop, x: number, y: number, frame: Frame): Crop {
  return fitted({ ...crop, left: crop.left + x, top: crop.top + y }, frame);
}

/** A rectangle of which some sides are elsewhere; the others stay where they are. */
export function resized(crop: Crop, sides: Sides, x: number, y: number, frame: Frame): Crop {
  const [left, width] = stretched(crop.left, crop.width, sides.x, x, frame.width);
  const [top, height] = stretched(crop.top, crop.height, sides.y, y, frame.height);
  return { left, top, width, height };
}

/** A rectangle of which one number was typed: the same size elsewhere, smaller where that would not fit; or another size. */
export function typed(crop: Crop, name: keyof Crop, value: number, frame: Frame): Crop {
  if (Number.isNaN(value)) return crop;
  const side = name === "left" || name === "width" ? "width" : "height";
  const start = side === "width" ? "left" : "top";
  const place = name === start ? within(Math.round(value), 0, frame[side] - SHORTEST) : crop[start];
  const length = name === side ? Math.round(value) : crop[side];
  return fitted({ ...crop, [start]: place, [side]: Math.min(length, frame[side] - place) }, frame);
}

/** The rectangle between two places, however they lie. */
export function between(
  a: { readonly x: number; readonly y: number },
  b: { readonly x: number; readonly y: number },
  frame: Frame,
): Crop {
  const [left, right] = [Math.min(a.x, b.x), Math.max(a.x, b.x)].map((x) => within(x, 0, frame.width));
  const [top, bottom] = [Math.min(a.y, b.y), Math.max(a.y, b.y)].map((y) => within(y, 0, frame.height));
  const [x = 0, y = 0] = [left, top];
  return fitted({ left: x, top: y, width: (right ?? x) - x, height: (bottom ?? y) - y }, frame);
}

function stretched(start: number, length: number, which: -1 | 0 | 1, by: number, whole: number) {
  const end = start + length;
  const shortest = Math.min(SHORTEST, whole);
  if (which === -1) {
    const to = within(Math.round(start + by), 0, end - shortest);
    return [to, end - to] as const;
  }
  if (which === 1) return [start, within(Math.round(end + by), start + shortest, whole) - start] as const;
  return [start, length] as const;
}

function within(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
