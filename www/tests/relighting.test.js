import assert from "node:assert/strict";
import { test } from "node:test";
import { source } from "./support/source.js";

/** @type {typeof import("../src/relight/shading.js")} */
const { anglesOf, exponentOf, FIRST, PLAIN, Shader, shaped } = await source("relight/shading.ts");
/** @type {typeof import("../src/relight/residual.js")} */
const { compare, greyOf, matteOf, matteUnder, Mean } = await source("relight/residual.ts");
/** @type {typeof import("../src/relight/encoding.js")} */
const { decode, encode } = await source("relight/encoding.ts");

/** @param {number} found @param {number} expected */
const near = (found, expected) => assert.ok(Math.abs(found - expected) < 1e-6, `${found} is not ${expected}`);

const overhead = { x: 0, y: 0, brightness: 1 };

test("a matt surface is brightest where it faces the lamp, and the lobe is beside the diffuse part", () => {
  const matt = new Shader([overhead], { ...PLAIN, specular: 0 });
  const [facing, none] = matt.light(0, 0, 1);
  near(facing, 1.15 * 1.015);
  near(none, 0);
  const [aside] = matt.light(0.6, 0, 0.8);
  near(aside, 1.15 * 0.815);
  const glossy = new Shader([overhead], { ...PLAIN, diffuse: 0, specular: 1, gloss: 0 });
  const [diffuse, reflected] = glossy.light(0.6, 0, 0.8);
  near(diffuse, 0);
  near(reflected, 1.15 * 0.8 ** 2);
  assert.deepEqual([exponentOf(0), exponentOf(1)], [2, 1024]);
});

test("lamps add up", () => {
  const one = new Shader([overhead], PLAIN).light(0.2, 0.1, Math.sqrt(0.95));
  const two = new Shader([overhead, overhead], PLAIN).light(0.2, 0.1, Math.sqrt(0.95));
  near(two[0], 2 * one[0]);
  near(two[1], 2 * one[1]);
  assert.deepEqual(new Shader([], PLAIN).light(0, 0, 1), [0, 0]);
});

test("slopes are exaggerated and turned inside out, and normals stay of length one", () => {
  const normal = /** @type {const} */ ([0.3, -0.4, Math.sqrt(0.75)]);
  const [x, y, z] = shaped(normal, { detail: 2, flipped: true });
  near(Math.hypot(x, y, z), 1);
  near(x / z, (-2 * 0.3) / Math.sqrt(0.75));
  near(y / z, (2 * 0.4) / Math.sqrt(0.75));
  assert.equal(shaped(normal, { detail: 0, flipped: false })[2], 1);
  const [a = 0, b = 0, c = 0, , , half = 0] = anglesOf(FIRST);
  near(Math.hypot(a, b, c), 1);
  assert.ok(half > c);
});

test("the residual is what one brightness cannot explain", () => {
  const normals = new Float32Array([0, 0, 1, 0.6, 0, 0.8, -0.6, 0, 0.8, 0, 0, 0]);
  const matte = { width: 4, height: 1, normals, grey: new Float32Array([0.5, 0.5, 1, 0.3]) };
  const expected = matteUnder(matte, [0, 0, 1]);
  assert.deepEqual(
    [...expected].map((value) => Math.round(1000 * value)),
    [500, 400, 800, Number.NaN],
  );
  const exact = compare(
    expected,
    expected.map((value) => 3 * value),
  );
  near(exact.brightness, 3);
  near(exact.mean, 0);
  const spoiled = compare(expected, new Float32Array([0.5, 0.4, 1.6, 1]));
  const [first = 0, second = 0, third = 0, outside = 0] = spoiled.residual;
  assert.ok(third > second && third > first);
  assert.ok(Number.isNaN(outside));
  const mean = new Mean();
  mean.add(new Float32Array([1, 2]));
  mean.add(new Float32Array([3, 6]));
  assert.deepEqual([...mean.map], [2, 4]);
});

test("surfaces are compared in fewer pixels", () => {
  const albedo = new Uint8Array([255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255]);
  const normals = new Float32Array([1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0]);
  const matte = matteOf({ width: 2, height: 2, normals, albedo }, 1, 1);
  assert.deepEqual([...matte.normals], [-1, 0, 0]);
  assert.deepEqual([...matte.grey], [0]);
  near(greyOf(albedo)[0] ?? 0, 1);
});

test("sRGB is encoded and decoded", () => {
  for (const code of [0, 20, 128, 200, 255]) assert.ok(Math.abs(encode(decode(code)) - code) <= 1);
  assert.equal(encode(7), 255);
});
