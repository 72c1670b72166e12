import assert from "node:assert/strict";
import { test } from "node:test";
import { source } from "./support/source.js";

/** @type {typeof import("../src/viewer/view.js")} */
const { fit, isFit, pan, placeOf, resized, toFrame, zoom } = await source("viewer/view.ts");
/** @type {typeof import("../src/viewer/histogram.js")} */
const { spreadOf, spreadWords } = await source("viewer/histogram.ts");
/** @type {typeof import("../src/viewer/readout.js")} */
const { readout, tilt } = await source("viewer/readout.ts");
/** @type {typeof import("../src/viewer/ramp.js")} */
const { quantile, ramp, ramped } = await source("viewer/ramp.ts");
/** @type {typeof import("../src/stack_name.js")} */
const { nameOf } = await source("stack_name.ts");

const frame = { width: 200, height: 100 };
const canvas = { width: 400, height: 400 };

test("the whole frame fits the canvas and lies in its middle", () => {
  const view = fit(frame, canvas);
  assert.deepEqual(placeOf(view, frame, canvas), { left: 0, top: 100, width: 400, height: 200 });
  assert.ok(isFit(view, frame, canvas));
});

test("what is under the pointer stays there while the picture grows", () => {
  const view = fit(frame, canvas);
  const before = toFrame(view, canvas, 120, 160);
  const larger = zoom(view, frame, canvas, 3, 120, 160);
  assert.equal(larger.scale, 6);
  const after = toFrame(larger, canvas, 120, 160);
  for (const axis of /** @type {const} */ ([0, 1])) assert.ok(Math.abs(after[axis] - before[axis]) < 1e-9);
});

test("sizes have limits, and the frame cannot be lost", () => {
  let view = fit(frame, canvas);
  for (let step = 0; step < 40; step++) view = zoom(view, frame, canvas, 2);
  assert.equal(view.scale, 48);
  for (let step = 0; step < 80; step++) view = zoom(view, frame, canvas, 0.5);
  assert.equal(view.scale, 0.5);
  view = pan(view, frame, 1e6, -1e6);
  assert.deepEqual([view.x, view.y], [0, 100]);
});

test("another size of the canvas keeps a whole frame whole, and an enlarged one as it is", () => {
  const wider = { width: 800, height: 300 };
  assert.deepEqual(resized(fit(frame, canvas), frame, canvas, wider), fit(frame, wider));
  const enlarged = zoom(fit(frame, canvas), frame, canvas, 2);
  assert.deepEqual(resized(enlarged, frame, canvas, wider), enlarged);
});

test("histograms count what is on the object", () => {
  const values = [0, 0.1, 0.9, 1, Number.NaN, 2];
  const spread = spreadOf({ at: (pixel) => values[pixel] ?? Number.NaN }, values.length, [0, 1], 2);
  assert.equal(spread.count, 5);
  assert.deepEqual(
    [...spread.bins].map((share) => Math.round(5 * share)),
    [2, 3],
  );
  assert.equal(spreadWords("z", spread), "z 0 to 2, mean 0.80");
  const none = spreadOf({ at: () => Number.NaN }, 10, [0, 1], 2);
  assert.equal(spreadWords("z", none), "z: no pixels");
});

test("the read-out names the pixel, its normal, its tilt, albedo and depth", () => {
  const known = {
    width: 2,
    height: 1,
    normals: new Float32Array([0, -0.6, 0.8, 0, 0, 0]),
    albedo: new Float32Array([0.1, 0.2, 0.3, 0, 0, 0]),
    depth: new Float32Array([12.5, Number.NaN]),
  };
  assert.deepEqual(readout(known, 0, 0), [
    ["pixel", "0, 0"],
    ["normal", " 0.000 −0.600  0.800"],
    ["tilt", "36.9°"],
    ["albedo", "0.100 0.200 0.300"],
    ["depth", "12.5 px"],
  ]);
  assert.deepEqual(readout(known, 1, 0)[1], ["", "outside the object"]);
  assert.deepEqual(readout(known, 2, 0), []);
  assert.equal(tilt(1.0000001), 0);
});

test("colours of numbers rise in lightness, and are clear where there is no number", () => {
  const lightness = Array.from({ length: 11 }, (_, step) => ramp(step / 10)).map(
    ([red, green, blue]) => 0.3 * red + 0.6 * green + 0.1 * blue,
  );
  for (const [index, value] of lightness.entries()) {
    if (index > 0) assert.ok(value > (lightness[index - 1] ?? 0));
  }
  const colours = ramped(new Float32Array([0, Number.NaN, 5]), [0, 1]);
  assert.deepEqual([colours[3], colours[7], colours[11]], [255, 0, 255]);
  assert.equal(quantile(new Float32Array([5, 1, Number.NaN, 3]), 0.5), 3);
});

test("stacks are called by their folder, or by their first and last file", () => {
  const file = (/** @type {string} */ name, path = "") => ({ name, webkitRelativePath: path });
  assert.equal(nameOf([]), "");
  assert.equal(nameOf([file("a.zip")]), "a.zip");
  assert.equal(nameOf([file("2.png", "shots/owl/2.png"), file("3.png", "shots/owl/3.png")]), "owl");
  assert.equal(nameOf([file("10.png"), file("2.png")]), "2.png … 10.png");
});
