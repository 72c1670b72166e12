import assert from "node:assert/strict";
import { test } from "node:test";
import { source } from "./support/source.js";

/** @type {typeof import("../src/large/average.js")} */
const { Average } = await source("large/average.ts");
/** @type {typeof import("../src/crop/rectangle.js")} */
const { between, fitted, moved, resized } = await source("crop/rectangle.ts");

/**
 * A picture made smaller; its codes are those of a function.
 * @param {[number, number]} from @param {[number, number]} to
 * @param {(x: number, y: number) => [number, number, number, number]} code @param {boolean} [linear]
 */
function averaged([width, height], [toWidth, toHeight], code, linear = false) {
  const average = new Average(width, height, toWidth, toHeight, linear);
  for (let y = 0; y < height; y++)
    average.add(Uint8ClampedArray.from(Array.from({ length: width }, (_, x) => code(x, y)).flat()));
  return average.pixels;
}

/** @param {number} code @returns {[number, number, number, number]} */
const grey = (code) => [code, code, code, 255];
const checkers = (/** @type {number} */ x, /** @type {number} */ y) => grey(255 * ((x + y) % 2));

test("black and white squares become the grey that sends as much light", () => {
  // sRGB of a half is 1.055 * 0.5 ** (1 / 2.4) - 0.055 = 0.7354.
  for (const side of [2, 4]) {
    const pixels = averaged([8, 8], [8 / side, 8 / side], checkers);
    assert.deepEqual([...new Set(pixels)], [188, 255]);
  }
  assert.deepEqual([...new Set(averaged([8, 8], [4, 4], checkers, true))], [128, 255]);
});

test("every code stays what it is in a picture of one code, also where sides do not divide", () => {
  for (let code = 0; code < 256; code++)
    assert.deepEqual(
      [...new Set(averaged([7, 5], [4, 3], () => grey(code)))].sort(),
      [...new Set([code, 255])].sort(),
    );
});

test("a pixel that two new ones share goes to both by their parts", () => {
  // Three columns to two: the middle one is halved.
  const pixels = averaged([3, 1], [2, 1], (x) => grey([0, 90, 255][x] ?? 0), true);
  assert.deepEqual([pixels[0], pixels[4]], [30, 200]);
});

test("what is transparent has no part in the colour", () => {
  const pixels = averaged([2, 2], [1, 1], (x) => (x === 0 ? [200, 100, 50, 255] : [0, 0, 0, 0]));
  assert.deepEqual([...pixels], [200, 100, 50, 128]);
});

test("a crop stays in the frame, keeps what is not moved, and never gets too small", () => {
  const frame = { width: 300, height: 200 };
  const crop = { left: 10, top: 20, width: 100, height: 80 };
  assert.deepEqual(moved(crop, 500, -500, frame), { ...crop, left: 200, top: 0 });
  assert.deepEqual(resized(crop, { x: -1, y: 1 }, -40, 500, frame), {
    left: 0,
    top: 20,
    width: 110,
    height: 180,
  });
  assert.deepEqual(resized(crop, { x: -1, y: 0 }, 500, 9, frame), { ...crop, left: 94, width: 16 });
  assert.deepEqual(between({ x: 90, y: 150 }, { x: -20, y: 30 }, frame), {
    left: 0,
    top: 30,
    width: 90,
    height: 120,
  });
  assert.deepEqual(fitted({ left: 299, top: 0, width: Number.MAX_VALUE, height: 1 }, frame), {
    left: 0,
    top: 0,
    width: 300,
    height: 16,
  });
});
