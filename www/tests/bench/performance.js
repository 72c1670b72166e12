// How long the page keeps people waiting, in processor time: `npm run bench --workspace www`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { greyPng, squareMask } from "../support/files.js";
import { quickPage } from "../support/page.js";
import { FRAME, LONGEST, traced } from "../support/tasks.js";

const page = await quickPage();
const tab = page.page;

test("no task stops the page while it estimates and shows a megapixel, and frames are drawn quickly", async (t) => {
  const side = 1024;
  // A small object: the page's own work grows with the frame, the estimator's with the object.
  await page.upload([
    greyPng("x.png", side, side, 200, "x"),
    greyPng("y.png", side, side, 200, "y"),
    greyPng("xy.png", side, side, 200, "both"),
    squareMask(side, 32),
  ]);
  await page.thumbnails(4);
  await tab.evaluate(() => document.getElementById("viewer-spread")?.replaceChildren());
  const estimating = await traced(tab, async () => {
    assert.equal(await page.estimate(), "");
    // The last that is shown of a result.
    await tab.waitForSelector("#viewer-spread:has-text('red')");
  });
  t.diagnostic(`${estimating.tasks} tasks, the longest of ${estimating.longest.toFixed(0)} ms`);
  assert.ok(estimating.tasks > 100);
  assert.ok(estimating.longest < LONGEST, `a task takes ${estimating.longest} ms of processor time`);

  const canvas = tab.locator("#viewer-canvas");
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  assert.ok(box);
  const drag = async () => {
    await tab.mouse.move(box.x + box.width / 3, box.y + box.height / 2);
    await tab.mouse.down();
    await tab.mouse.move(box.x + (2 * box.width) / 3, box.y + box.height / 3, { steps: 30 });
    await tab.mouse.up();
  };
  for (const map of ["relit", "normals"]) {
    await tab.selectOption("#viewer-map", map);
    const { frames, frame, drawing } = await traced(tab, drag);
    const each = `${drawing.toFixed(1)} ms of ${frame.toFixed(1)} ms for each of ${frames} frames`;
    t.diagnostic(`${map}: the page draws ${each}`);
    assert.ok(frames > 5 && drawing < FRAME, `the page draws ${drawing} ms of processor time`);
  }
  page.assertQuiet();
});
