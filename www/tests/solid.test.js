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
  const [width, height] = [4, 3];
  const made = (/** @type {(column: number, row: number) => number} */ at) => {
    const depth = Float32Array.from({ length: width * height }, (_, pixel) =>
      at(pixel % width, Math.floor(pixel / width)),
    );
    const normals = Float32Array.from({ length: 3 * depth.length }, (_, index) => (index % 3 === 2 ? 1 : 0));
    const albedo = new Uint8Array(4 * depth.length).fill(255);
    return heightField({ width, height, depth, normals, albedo }, 1);
  };
  const plane = made(() => 1);
  assert.equal(plane.positions.length / 3, 12);
  assert.equal(plane.triangles.length / 3, 12);
  assert.deepEqual([...plane.positions.subarray(0, 3)], [-0.75, 0.5, 0.5]);
  assert.deepEqual([...plane.colours.subarray(0, 3)], [1, 1, 1]);
  // Against the clock as the camera sees it: the cross product points to it.
  const [a = 0, b = 0, c = 0] = plane.triangles;
  const place = (/** @type {number} */ vertex) => plane.positions.subarray(3 * vertex, 3 * vertex + 2);
  const [[ax = 0, ay = 0], [bx = 0, by = 0], [cx = 0, cy = 0]] = [place(a), place(b), place(c)];
  assert.ok((bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0);
  assert.equal(made((column) => (column < 2 ? 0 : 40)).triangles.length / 3, 8);
  const holed = made((column, row) => (column === 0 && row === 0 ? Number.NaN : 0));
  assert.equal(holed.positions.length / 3, 8, "the rim of a hole is left out");
  assert.equal(holed.triangles.length / 3, 5);
  assert.equal(stepFor(1000, 1000, 250_000), 2);
});

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
