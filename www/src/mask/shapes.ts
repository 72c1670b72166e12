import type { Tiles } from "./tiles.js";

/** A place on the photograph in pixels; whole numbers are corners of pixels. */
export interface Place {
  readonly x: number;
  readonly y: number;
}

/** A rectangle on the photograph in pixels. */
export interface Box {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** Sets all pixels whose centres are no further than `radius` from the line between two places. */
export function stroke(tiles: Tiles, a: Place, b: Place, radius: number, value: number): Box {
  const box = {
    left: Math.floor(Math.min(a.x, b.x) - radius),
    top: Math.floor(Math.min(a.y, b.y) - radius),
    right: Math.ceil(Math.max(a.x, b.x) + radius),
    bottom: Math.ceil(Math.max(a.y, b.y) + radius),
  };
  const sides = sidesOf(a, b, radius);
  const [top, bottom] = [Math.max(box.top, 0), Math.min(box.bottom, tiles.height)];
  for (let y = top; y < bottom; y++) {
    // The shape is convex, so a row meets it in one piece: from the least to the most of its parts.
    let [from, to] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    const meet = (first: number, last: number) => {
      from = Math.min(from, first);
      to = Math.max(to, last);
    };
    for (const end of [a, b]) {
      const square = radius * radius - (y + 0.5 - end.y) ** 2;
      if (square >= 0) meet(end.x - Math.sqrt(square), end.x + Math.sqrt(square));
    }
    for (const x of crossings(sides, y + 0.5)) meet(x, x);
    fillBetween(tiles, y, from, to, value);
  }
  return box;
}

/** Sets all pixels whose centres lie within a closed line; where it winds over itself, every second time not. */
export function polygon(tiles: Tiles, places: readonly Place[], value: number): void {
  const rows = places.map(({ y }) => y);
  const [top, bottom] = [
    Math.max(Math.floor(Math.min(...rows)), 0),
    Math.min(Math.max(...rows), tiles.height),
  ];
  for (let y = top; y < bottom; y++) {
    const along = crossings(places, y + 0.5).sort((first, second) => first - second);
    for (let at = 0; at + 1 < along.length; at += 2)
      fillBetween(tiles, y, along[at] ?? 0, along[at + 1] ?? 0, value);
  }
}

/** Sets the pixels of a row whose centres lie between two places. */
function fillBetween(tiles: Tiles, y: number, from: number, to: number, value: number): void {
  const [first, last] = [Math.ceil(from - 0.5), Math.floor(to - 0.5)];
  if (first <= last) tiles.span(y, first, last, value);
}

/** Where a closed line meets a row. */
function crossings(places: readonly Place[], y: number): number[] {
  return places.flatMap((a, index) => {
    const b = places[(index + 1) % places.length] ?? a;
    // One end belongs to the line, the other to the next: no corner counts twice.
    if (a.y <= y === b.y <= y) return [];
    return [a.x + ((y - a.y) / (b.y - a.y)) * (b.x - a.x)];
  });
}

/** The corners of the rectangle along a line. */
function sidesOf(a: Place, b: Place, radius: number): Place[] {
  const length = Math.hypot(b.x - a.x, b.y - a.y);
  if (length === 0) return [];
  const [x, y] = [(-(b.y - a.y) / length) * radius, ((b.x - a.x) / length) * radius];
  return [
    { x: a.x + x, y: a.y + y },
    { x: b.x + x, y: b.y + y },
    { x: b.x - x, y: b.y - y },
    { x: a.x - x, y: a.y - y },
  ];
}
