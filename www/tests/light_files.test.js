import assert from "node:assert/strict";
import { test } from "node:test";
import { source } from "./support/source.js";

const [text, coverageModule, light] = await Promise.all([
  source("lights/light_text.ts"),
  source("lights/coverage.ts"),
  source("lights/light.ts"),
]);
const { toCsv, toLp, toJson, lightsOf } = text;
const { coverage, widest } = coverageModule;

/** A light from degrees around and above the picture. @param {number} around @param {number} above */
function from(around, above, confidence = 0.9, file = `${around}.png`) {
  const [a, b] = [(around * Math.PI) / 180, (above * Math.PI) / 180];
  return {
    file,
    x: Math.cos(b) * Math.cos(a),
    y: Math.cos(b) * Math.sin(a),
    z: Math.sin(b),
    intensity: 1.25,
    confidence,
  };
}

/** Lights all around. @param {number} count @param {number} above @param {number} [first] @param {number} [last] */
const ring = (count, above, first = 0, last = 360) =>
  Array.from({ length: count }, (_, index) => from(first + ((last - first) * index) / count, above));

const lights = [from(10, 40, 0.5, "a.png"), from(200, 70, 0.25, 'x "y", z.png'), from(90, 5, 1, "12 3.png")];

/** @param {any[]} found @param {any[]} expected @param {(keyof typeof lights[0])[]} keys */
function alike(found, expected, keys) {
  assert.deepEqual(
    found.map(({ file }) => file),
    expected.map(({ file }) => file),
  );
  for (const [index, one] of found.entries())
    for (const key of keys)
      assert.ok(Math.abs(one[key] - expected[index][key]) < 2e-6, `${key} of ${one.file}`);
}

test("lights are the same after they were saved and loaded", () => {
  alike(lightsOf(toCsv(lights), "lights.csv"), lights, ["x", "y", "z", "intensity", "confidence"]);
  alike(lightsOf(toJson(lights), "lights.json"), lights, ["x", "y", "z", "intensity", "confidence"]);
  const plain = lights.filter(({ file }) => !file.includes('"'));
  alike(lightsOf(toLp(plain), "lights.lp"), plain, ["x", "y", "z"]);
});

test("directions become unit vectors, and what is no light is said", () => {
  const [first] = lightsOf('[{ "x": 0, "y": 3, "z": 4 }]', "a.json");
  assert.deepEqual([first.x, first.y, first.z, first.file, first.intensity], [0, 0.6, 0.8, "1", 1]);
  assert.throws(() => lightsOf("[{", "a.json"), /a\.json: it is not complete JSON/);
  assert.throws(() => lightsOf('[{ "x": 0 }]', "a.json"), /light 1 has no direction/);
  assert.throws(() => lightsOf("hello", "a.lp"), /a\.lp: no lights/);
});

test("good lights leave nothing to say", () => {
  assert.deepEqual(coverage([...ring(8, 45), ...ring(4, 70)]), []);
});

test("what is bad about the lamp's places is said", () => {
  assert.match(coverage(ring(12, 80))[0], /^All lamps lie within 10 degrees of one direction/);
  assert.match(coverage(ring(9, 45, 110, 250))[0], /^All lamps came from the left/);
  assert.match(coverage(ring(9, 45, -70, 70))[0], /^All lamps came from the right/);
  assert.match(coverage([...ring(9, 45, 20, 160), from(270, 60)])[0], /^Nearly all lamps came from the top/);
  assert.match(coverage(ring(12, 10))[0], /^The lamps graze the object/);
  const doubtful = ring(8, 45).map((one, index) => ({ ...one, confidence: index < 3 ? 0.2 : 0.9 }));
  assert.match(coverage(doubtful)[0], /^3 of 8 lights are doubtful \(0\.png, 45\.png, 90\.png\)/);
});

test("the widest angle from the mean is that of a cone", () => {
  assert.ok(Math.abs(widest(ring(12, 60)) - 30) < 1e-6);
});

test("directions in words", () => {
  assert.equal(light.inWords(from(180, 30)), "left, 30° above the picture");
  assert.equal(light.inWords(from(315, 45)), "lower right, 45° above the picture");
  assert.equal(light.inWords(from(0, 88)), "beside the camera");
});
