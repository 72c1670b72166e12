import assert from "node:assert/strict";
import { test } from "node:test";
import { inflateSync } from "node:zlib";
import { source } from "./support/source.js";

const [tilesModule, historyModule, shapes, operations, png] = await Promise.all([
  source("mask/tiles.ts"),
  source("mask/history.ts"),
  source("mask/shapes.ts"),
  source("mask/operations.ts"),
  source("mask/png.ts"),
]);
const { Tiles, TILE } = tilesModule;
const { History } = historyModule;
const { stroke, polygon } = shapes;
const { grow, shrink, fillHoles, threshold } = operations;

/** Numbers that look random and are the same each time. */
function numbers() {
  let state = 7;
  return () => {
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
  };
}

/** A mask by a rule. @param {number} width @param {number} height @param {(x: number, y: number) => boolean} inside */
const maskOf = (width, height, inside) =>
  Uint8Array.from({ length: width * height }, (_, at) =>
    inside(at % width, Math.floor(at / width)) ? 255 : 0,
  );

/** All pixels of tiles. @param {any} tiles */
const pixelsOf = (tiles) => maskOf(tiles.width, tiles.height, (x, y) => tiles.at(x, y) === 255);

/** @param {Uint8Array} mask */
const count = (mask) => mask.reduce((sum, value) => sum + (value ? 1 : 0), 0);

test("a pixel grows to the lattice points of a disc, and shrinks back", () => {
  // Gauss's circle problem: points with whole coordinates in a circle of this radius.
  const points = [1, 5, 13, 29, 49, 81, 113, 149];
  const dot = maskOf(41, 41, (x, y) => x === 20 && y === 20);
  for (const [radius, expected] of points.entries()) {
    const disc = grow(dot, 41, 41, radius);
    assert.equal(count(disc), expected, `radius ${radius}`);
    assert.deepEqual(shrink(disc, 41, 41, radius), dot, `radius ${radius}`);
  }
});

test("growing and shrinking agree with their definitions on any mask", () => {
  const random = numbers();
  const [width, height] = [37, 23];
  const mask = maskOf(width, height, () => random() < 0.03);
  for (const radius of [1, 2, 5, 40]) {
    const near = maskOf(width, height, (x, y) =>
      mask.some((value, at) => {
        const [a, b] = [at % width, Math.floor(at / width)];
        return value === 255 && (a - x) ** 2 + (b - y) ** 2 <= radius ** 2;
      }),
    );
    assert.deepEqual(grow(mask, width, height, radius), near);
    const opposite = mask.map((value) => 255 - value);
    assert.deepEqual(
      shrink(opposite, width, height, radius),
      near.map((value) => 255 - value),
    );
  }
});

test("a mask of the whole frame stays whole when it shrinks", () => {
  const whole = maskOf(30, 20, () => true);
  assert.deepEqual(shrink(whole, 30, 20, 5), whole);
});

test("holes are filled, bays and corners are not", () => {
  const ring = maskOf(60, 60, (x, y) => Math.abs(Math.hypot(x - 30, y - 30) - 20) < 3);
  const disc = maskOf(60, 60, (x, y) => Math.hypot(x - 30, y - 30) < 23);
  assert.deepEqual(fillHoles(ring, 60, 60), disc);
  const open = ring.slice();
  for (let y = 30; y < 60; y++) open[y * 60 + 30] = 0;
  assert.deepEqual(fillHoles(open, 60, 60), open);
  // Water does not pass between two pixels that touch at a corner.
  const diamond = maskOf(9, 9, (x, y) => Math.abs(x - 4) + Math.abs(y - 4) === 3);
  assert.equal(count(fillHoles(diamond, 9, 9)), 25);
});

test("a labyrinth without end is no hole", () => {
  const walls = maskOf(101, 101, (x, y) => y % 2 === 1 && x !== (y % 4 === 1 ? 100 : 0));
  assert.deepEqual(fillHoles(walls, 101, 101), walls);
});

test("threshold takes the level itself as bright", () => {
  const grey = Uint8Array.of(0, 99, 100, 101, 255);
  assert.deepEqual([...threshold(grey, 100, true)], [0, 0, 255, 255, 255]);
  assert.deepEqual([...threshold(grey, 100, false)], [255, 255, 0, 0, 0]);
});

test("a stroke takes the pixels that are near enough to its line", () => {
  const random = numbers();
  const [width, height] = [300, 280];
  for (let round = 0; round < 12; round++) {
    const tiles = new Tiles(width, height);
    const place = () => ({ x: random() * 340 - 20, y: random() * 320 - 20 });
    const [a, b, radius] = [place(), round === 0 ? { x: 256, y: 256 } : place(), 1 + random() * 40];
    if (round === 0) Object.assign(a, b);
    stroke(tiles, a, b, radius, 255);
    const square = (b.x - a.x) ** 2 + (b.y - a.y) ** 2;
    const wrong = maskOf(width, height, (x, y) => {
      const [px, py] = [x + 0.5 - a.x, y + 0.5 - a.y];
      const along = square === 0 ? 0 : (px * (b.x - a.x) + py * (b.y - a.y)) / square;
      const share = Math.min(Math.max(along, 0), 1);
      const distance = Math.hypot(px - share * (b.x - a.x), py - share * (b.y - a.y));
      return Math.abs(distance - radius) > 1e-6 && distance < radius !== (tiles.at(x, y) === 255);
    });
    assert.equal(count(wrong), 0, `round ${round}`);
  }
});

test("a polygon has its area, and crosses tiles", () => {
  const tiles = new Tiles(600, 600);
  const corners = [
    [100, 100],
    [500, 100],
    [500, 400],
    [300, 250],
    [100, 400],
  ].map(([x, y]) => ({ x, y }));
  polygon(tiles, corners, 255);
  // A rectangle without the notch below: 400 x 300 less a triangle of 400 x 150 / 2.
  assert.ok(Math.abs(tiles.count() - 90_000) < 300, String(tiles.count()));
  assert.equal(tiles.at(300, 249), 255);
  assert.equal(tiles.at(300, 252), 0);
  polygon(tiles, corners, 0);
  assert.equal(tiles.count(), 0);
});

test("steps are undone and done again, exactly", () => {
  const random = numbers();
  const tiles = new Tiles(700, 500);
  const history = new History(tiles);
  const states = [pixelsOf(tiles)];
  for (let step = 0; step < 9; step++) {
    if (step === 4) tiles.fill(255);
    else if (step === 6) for (let at = 0; at < tiles.length; at++) tiles.takeTile(at, states[2]);
    else
      stroke(
        tiles,
        { x: random() * 700, y: random() * 500 },
        { x: random() * 700, y: random() * 500 },
        30,
        step % 2 ? 0 : 255,
      );
    if (history.commit()) states.push(pixelsOf(tiles));
  }
  assert.ok(states.length > 7);
  const last = states.at(-1);
  for (const state of states.toReversed()) {
    assert.deepEqual(pixelsOf(tiles), state);
    assert.equal(tiles.count(), count(state));
    history.undo();
  }
  assert.equal(history.canUndo, false);
  while (history.canRedo) history.redo();
  assert.deepEqual(pixelsOf(tiles), last);
});

test("the history gives up its oldest steps when it takes too much memory", () => {
  const tiles = new Tiles(20 * TILE, TILE);
  const history = new History(tiles, 5 * TILE * TILE);
  for (let round = 0; round < 3; round++) {
    for (let tile = 0; tile < 20; tile++) {
      const place = { x: (tile + 0.5) * TILE, y: 128 };
      stroke(tiles, place, place, 10 + 5 * round, 255);
      history.commit();
    }
  }
  assert.ok(history.bytes <= 5 * TILE * TILE);
  let steps = 0;
  for (; history.canUndo; steps++) history.undo();
  assert.equal(steps, 5);
});

test("all pixels inside are counted, none beyond the frame", () => {
  const tiles = new Tiles(1000, 333);
  tiles.fill(255);
  assert.equal(tiles.count(), 333_000);
  const whole = new Uint8Array(333_000);
  for (let row = 0; row < tiles.rows; row++) tiles.copyRow(row, whole);
  assert.equal(count(whole), 333_000);
});

test("the file of a mask is a grey PNG of 8 bits", async () => {
  const mask = maskOf(70, 40, (x, y) => (x ^ y) % 3 === 0);
  const bytes = Buffer.from(await (await png.greyPng(mask, 70, 40)).arrayBuffer());
  assert.deepEqual(bytes.subarray(0, 8), Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]));
  assert.deepEqual([...bytes.subarray(16, 29)], [0, 0, 0, 70, 0, 0, 0, 40, 8, 0, 0, 0, 0]);
  const length = bytes.readUInt32BE(33);
  const rows = inflateSync(bytes.subarray(41, 41 + length));
  const pixels = mask.map((_, at) => rows[Math.floor(at / 70) * 71 + 1 + (at % 70)] ?? 1);
  assert.deepEqual(pixels, mask);
});
