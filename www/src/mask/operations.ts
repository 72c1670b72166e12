/** Operations on a whole mask, a byte for each pixel, row after row; 255 is inside. */

/** The largest radius: distances fit into a byte. */
export const MOST_PIXELS = 200;

/** All pixels no further than `radius` from one that is inside. */
export function grow(
  mask: Uint8Array,
  width: number,
  height: number,
  radius: number,
): Uint8Array<ArrayBuffer> {
  const reach = Math.min(Math.max(Math.round(radius), 0), MOST_PIXELS);
  const away = verticalDistances(mask, width, height, reach + 1);
  // How far a pixel reaches along its row when the nearest inside above or below it is that far away.
  const across = Int32Array.from({ length: reach + 2 }, (_, distance) =>
    distance > reach ? -1 : Math.floor(Math.sqrt(reach * reach - distance * distance)),
  );
  const grown = new Uint8Array(width * height);
  for (let start = 0; start < grown.length; start += width) {
    const end = start + width;
    for (let at = start, to = -1; at < end; at++) {
      const far = across[away[at] ?? 0] ?? -1;
      if (far >= 0 && at + far > to) to = at + far;
      if (at <= to) grown[at] = 255;
    }
    for (let at = end - 1, to = end; at >= start; at--) {
      const far = across[away[at] ?? 0] ?? -1;
      if (far >= 0 && at - far < to) to = at - far;
      if (at >= to) grown[at] = 255;
    }
  }
  return grown;
}

/** All pixels further than `radius` from every one outside; beyond the frame nothing is outside. */
export function shrink(
  mask: Uint8Array,
  width: number,
  height: number,
  radius: number,
): Uint8Array<ArrayBuffer> {
  return invert(grow(invert(mask), width, height, radius));
}

export function invert(mask: Uint8Array): Uint8Array<ArrayBuffer> {
  return mask.map((value) => 255 - value);
}

/** The pixels that are as bright as `level` or brighter; or those that are darker. */
export function threshold(grey: Uint8Array, level: number, brighter: boolean): Uint8Array<ArrayBuffer> {
  return grey.map((value) => (value >= level === brighter ? 255 : 0));
}

/** Fills what is outside and cannot be reached from the frame's edge without crossing the inside. */
export function fillHoles(mask: Uint8Array, width: number, height: number): Uint8Array<ArrayBuffer> {
  const filled = new Uint8Array(width * height).fill(255);
  const open = (at: number) => mask[at] === 0 && filled[at] === 255;
  const seeds: number[] = [];
  for (let x = 0; x < width; x++) seeds.push(x, (height - 1) * width + x);
  for (let y = 0; y < height; y++) seeds.push(y * width, y * width + width - 1);
  for (let seed = seeds.pop(); seed !== undefined; seed = seeds.pop()) {
    if (!open(seed)) continue;
    const start = seed - (seed % width);
    let [first, last] = [seed, seed];
    while (first > start && open(first - 1)) first--;
    while (last < start + width - 1 && open(last + 1)) last++;
    filled.fill(0, first, last + 1);
    // Of each piece of the rows beside, one pixel is enough: it finds the others.
    for (const beside of [-width, width]) {
      if (first + beside < 0 || first + beside >= filled.length) continue;
      for (let at = first; at <= last; at++)
        if (open(at + beside) && (at === last || !open(at + beside + 1))) seeds.push(at + beside);
    }
  }
  return filled;
}

/** Distance of each pixel to the nearest inside in its column, at most `most`. */
function verticalDistances(mask: Uint8Array, width: number, height: number, most: number): Uint8Array {
  const away = new Uint8Array(width * height).fill(most);
  for (let at = 0; at < away.length; at++) {
    if (mask[at] !== 0) away[at] = 0;
    else if (at >= width) away[at] = Math.min((away[at - width] ?? most) + 1, most);
  }
  for (let at = away.length - width - 1; at >= 0; at--)
    away[at] = Math.min(away[at] ?? most, (away[at + width] ?? most) + 1);
  return away;
}
