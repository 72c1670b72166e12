import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { complaints } from "./support/axe.js";
import { sampleList } from "./support/files.js";
import { Page } from "./support/page.js";
import { source } from "./support/source.js";

const relief = sampleList()[1];
assert.ok(relief);
/** @type {Page} */
let page;
/** @type {import("playwright-core").Page} */
let tab;

before(async () => {
  page = await Page.open({ webgpu: false });
  tab = page.page;
  await page.estimateSample(relief);
  // Nothing below takes long.
  tab.setDefaultTimeout(40_000);
});
after(() => page.close());

test("height fields become meshes inside the mask, with tears where the depth has steps", async () => {
  /** @type {typeof import("../src/solid/height_field.js")} */
  const { heightField, stepFor } = await source("solid/height_field.ts");
  /** @param {number} width @param {number} height @param {(column: number, row: number) => number} at */
  const made = (width, height, at) => {
    const depth = Float32Array.from({ length: width * height }, (_, pixel) =>
      at(pixel % width, Math.floor(pixel / width)),
    );
    const normals = Float32Array.from({ length: 3 * depth.length }, (_, index) => (index % 3 === 2 ? 1 : 0));
    const albedo = new Uint8Array(4 * depth.length).fill(255);
    return heightField({ width, height, depth, normals, albedo }, 1);
  };
  const plane = made(4, 3, () => 1);
  assert.equal(plane.positions.length / 3, 12);
  assert.equal(plane.triangles.length / 3, 12);
  assert.deepEqual([...plane.positions.subarray(0, 3)], [-0.75, 0.5, 0.5]);
  assert.deepEqual([...plane.colours.subarray(0, 3)], [1, 1, 1]);
  // Against the clock as the camera sees it: the cross product points to it.
  const [a = 0, b = 0, c = 0] = plane.triangles;
  const place = (/** @type {number} */ vertex) => plane.positions.subarray(3 * vertex, 3 * vertex + 2);
  const [[ax = 0, ay = 0], [bx = 0, by = 0], [cx = 0, cy = 0]] = [place(a), place(b), place(c)];
  assert.ok((bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0);
  const stepped = made(12, 8, (column) => (column < 6 ? 0 : 40));
  const heights = (/** @type {number[]} */ corners) =>
    corners.map((vertex) => stepped.positions[3 * vertex + 2]);
  const levels = trianglesOf(stepped).map((corners) => new Set(heights(corners)).size);
  assert.ok(levels.length > 100 && levels.every((count) => count === 1), "no triangle climbs the step");
  const holed = made(16, 16, (column, row) => (column === 8 && row === 8 ? Number.NaN : 0));
  const nearest = Math.min(...placesOf(holed, 16).map(([x, y]) => Math.hypot(x - 0.5, y + 0.5)));
  assert.ok(nearest > 0.8 && nearest < 2, `the hole's rim is ${nearest} pixels from its middle`);
  assert.equal(stepFor(1000, 1000, 250_000), 2);
});

test("round objects end at a smooth line, though their pixels end in steps", async () => {
  /** @type {typeof import("../src/solid/height_field.js")} */
  const { heightField } = await source("solid/height_field.ts");
  const [radius, side] = [60, 130];
  const pixels = Array.from({ length: side * side }, (_, pixel) => {
    const [x, y] = [(pixel % side) + 0.5 - side / 2, side / 2 - Math.floor(pixel / side) - 0.5];
    const z = Math.sqrt(radius ** 2 - x ** 2 - y ** 2);
    return Number.isNaN(z) ? { z, normal: [0, 0, 0] } : { z, normal: [x / radius, y / radius, z / radius] };
  });
  const ball = heightField(
    {
      width: side,
      height: side,
      depth: Float32Array.from(pixels, ({ z }) => z),
      normals: Float32Array.from(pixels.flatMap(({ normal }) => normal)),
      albedo: new Uint8Array(4 * side * side).fill(255),
    },
    1,
  );
  // Edges of one triangle only are the rim.
  const edges = trianglesOf(ball).flatMap(([a = 0, b = 0, c = 0]) =>
    [
      [a, b],
      [b, c],
      [c, a],
    ].map((ends) => ends.sort((one, other) => one - other).join(" ")),
  );
  const counts = new Map();
  for (const edge of edges) counts.set(edge, (counts.get(edge) ?? 0) + 1);
  const rim = new Set([...counts].flatMap(([edge, count]) => (count === 1 ? edge.split(" ") : [])));
  const places = placesOf(ball, side);
  const away = [...rim].map((vertex) => Math.hypot(...(places[Number(vertex)] ?? [0, 0])));
  const [least, most] = [Math.min(...away), Math.max(...away)];
  assert.ok(least > radius - 2, `the rim is left out from ${least} pixels on`);
  assert.ok(most - least < 0.7, `the rim is ${least} to ${most} pixels from the middle`);
});

/** @typedef {import("../src/solid/height_field.js").HeightField} HeightField */

/** Three vertices each. @param {HeightField} mesh */
function trianglesOf({ triangles }) {
  return Array.from({ length: triangles.length / 3 }, (_, index) => [
    ...triangles.subarray(3 * index, 3 * index + 3),
  ]);
}

/** Right and up of the frame's middle, in pixels. @param {HeightField} mesh @param {number} side */
function placesOf({ positions }, side) {
  return Array.from(
    { length: positions.length / 3 },
    (_, index) =>
      /** @type {[number, number]} */ (
        [...positions.subarray(3 * index, 3 * index + 2)].map((at) => (at * side) / 2)
      ),
  );
}

test("the surface is turned in space by pointer and keys, under the lamps of the relighting", async () => {
  const scripts = () =>
    tab.evaluate(
      () => performance.getEntriesByType("resource").filter(({ name }) => /scene/.test(name)).length,
    );
  assert.equal(await scripts(), 0, "what draws in 3D is fetched before it is asked for");
  await tab.click("#solid-open");
  const canvas = tab.locator("#solid-canvas");
  await canvas.waitFor();
  assert.ok((await scripts()) > 0);
  /** @type {string[]} */
  const looks = [];
  const changed = async (/** @type {string} */ what) => {
    await tab.waitForTimeout(250);
    const look = (await canvas.screenshot()).toString("base64");
    assert.ok(!looks.includes(look), `${what} changes nothing`);
    looks.push(look);
  };
  await changed("opening");
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  assert.ok(box);
  await tab.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await tab.mouse.down();
  await tab.mouse.move(box.x + box.width / 2 + 90, box.y + box.height / 2 + 20, { steps: 4 });
  await tab.mouse.up();
  await changed("dragging");
  await canvas.press("ArrowLeft");
  await changed("an arrow key");
  await canvas.press("+");
  await changed("coming nearer");
  await tab.locator("#lamps .lamp").first().press("ArrowDown");
  await changed("another lamp");
  await tab.locator("#look-detail").fill("2");
  await changed("a deeper surface");
  await tab.check("#look-flipped");
  await changed("a hollow surface");
  assert.deepEqual(await complaints(tab, "#result"), []);
  // It needed the depth, which is a map like others now.
  await tab.selectOption("#viewer-map", "depth");
  await tab.waitForSelector("#viewer-spread:has-text('depth')");
  await tab.click("#solid-open");
  assert.equal(await canvas.count(), 0);
  await tab.click("#solid-open");
  await canvas.waitFor();
  page.assertQuiet();
});
