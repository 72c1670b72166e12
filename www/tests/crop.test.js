import assert from "node:assert/strict";
import { test } from "node:test";
import { AVIF_BALLS } from "./support/avif.js";
import { complaints } from "./support/axe.js";
import { greyMapMask, greyPng } from "./support/files.js";
import { quickPage } from "./support/page.js";

/** The photographs' side. */
const SIDE = 64;
const page = await quickPage();
const tab = page.page;

/** Whether a pixel lies in the mask: a shape without symmetry. @param {number} x @param {number} y */
const inside = (x, y) => x > 8 && x < 56 && y > 8 && y < 50 && 2 * y > x;

/** How many pixels of the mask a rectangle holds. @param {number} left @param {number} top @param {number} width @param {number} height */
function pixelsIn(left, top, width, height) {
  let count = 0;
  for (let y = top; y < top + height; y++)
    for (let x = left; x < left + width; x++) if (inside(x, y)) count += 1;
  return count;
}

/** A mask of the whole frame. */
const mask = greyMapMask(SIDE, inside);

/** What the editor says. */
const words = () => tab.textContent(".crop-editor .mask-words");

/** Drags from one place of the photograph to another. @param {[number, number]} from @param {[number, number]} to */
async function drag(from, to) {
  const box = await tab.locator(".crop-place").boundingBox();
  assert.ok(box);
  const [a, b] = [from, to].map(
    ([x, y]) => /** @type {const} */ ([box.x + (x / SIDE) * box.width, box.y + (y / SIDE) * box.height]),
  );
  assert.ok(a && b);
  await tab.mouse.move(...a);
  await tab.mouse.down();
  await tab.mouse.move(...b, { steps: 3 });
  await tab.mouse.up();
}

test("a rectangle is drawn by pointer and keys, and its numbers are typed", async () => {
  await page.upload([...AVIF_BALLS, mask]);
  await page.thumbnails(AVIF_BALLS.length + 1);
  await tab.click("#crop");
  await tab.waitForSelector(".crop-editor .crop-box:focus");
  assert.equal(await words(), "The whole frame, 64 × 64 pixels");
  assert.deepEqual(await complaints(tab, ".crop-editor"), []);
  // A handle of the whole frame, then what lies beside the rectangle, then its inside.
  await drag([64, 64], [20, 30]);
  assert.equal(await words(), "20 × 30 pixels, 0 from the left and 0 from the top");
  await drag([60, 60], [24, 30]);
  assert.equal(await words(), "36 × 30 pixels, 24 from the left and 30 from the top");
  await drag([40, 40], [36, 36]);
  assert.equal(await words(), "36 × 30 pixels, 20 from the left and 26 from the top");
  await tab.keyboard.press("ArrowLeft");
  await tab.keyboard.press("ArrowUp");
  await tab.keyboard.press("Shift+ArrowRight");
  await tab.keyboard.press("Shift+ArrowDown");
  assert.equal(await words(), "37 × 31 pixels, 19 from the left and 25 from the top");
  await tab.fill('[name="crop-left"]', "12");
  await tab.fill('[name="crop-top"]', "10");
  await tab.fill('[name="crop-width"]', "40");
  await tab.fill('[name="crop-height"]', "900");
  await tab.keyboard.press("Tab");
  assert.equal(await words(), "40 × 54 pixels, 12 from the left and 10 from the top");
  await tab.click('.crop-editor [data-do="done"]');
  await tab.waitForSelector(
    "#crop-words:text('Taken of all photographs: 40 × 54 pixels, 12 from the left and 10 from the top, of 64 × 64.')",
  );
  assert.equal(await tab.evaluate(() => document.activeElement?.id), "crop");
  assert.deepEqual(await complaints(tab, "#stack"), []);
});

test("photographs and mask are cropped alike, and the result says so", async () => {
  assert.equal(await page.estimate(), "");
  const size = "cropped to 40 × 54 pixels, 12 from the left and 10 from the top, from 64 × 64 pixels";
  const facts = (await tab.textContent("#facts")) ?? "";
  assert.ok(facts.includes(`4 of 40 × 54 pixels, ${size}`), facts);
  assert.ok(facts.includes(`, ${pixelsIn(12, 10, 40, 54).toLocaleString("en")} pixels`), facts);
  assert.ok((await tab.textContent("#plan"))?.includes(size));
  const report = JSON.parse(String(await page.download("report.json")));
  assert.deepEqual(report.photographs_crop, { left: 12, top: 10, width: 40, height: 54 });
  // The lights again: at the same part, with the result's mask.
  await tab.focus('.dot[aria-selected="true"]');
  await tab.keyboard.press("Shift+ArrowUp");
  await page.during(() => tab.click("#lights-again"));
  assert.equal(await tab.isVisible("#run-problem"), false);
  assert.ok((await tab.textContent("#facts"))?.includes(`4 of 40 × 54 pixels, ${size}`));
});

test("a crop survives a reload, goes when it is removed, and does not stay with other photographs", async () => {
  await tab.waitForSelector("#stack-kept:has-text('Kept on this device')");
  await tab.reload();
  await tab.click("#session-restore");
  await page.thumbnails(AVIF_BALLS.length + 1);
  await tab.waitForSelector("#crop-words:has-text('40 × 54 pixels')");
  await tab.click("#crop-remove");
  await tab.waitForSelector("#crop-words", { state: "hidden" });
  assert.equal(await page.estimate(), "");
  assert.match((await tab.textContent("#facts")) ?? "", /4 of 64 × 64 pixels/);
  await tab.click("#crop");
  await tab.fill('[name="crop-width"]', "30");
  await tab.click('.crop-editor [data-do="done"]');
  await tab.waitForSelector("#crop-words:visible");
  const odd = greyPng("ball_5.png", 60, 64, 200, "x");
  await tab.setInputFiles("#more", [{ name: odd.name, mimeType: "", buffer: Buffer.from(odd.bytes) }]);
  await tab.waitForSelector("#stack-words:has-text('5 photographs')");
  assert.match(
    (await page.estimate()) ?? "",
    /^ball_5\.png: cannot be cropped: it has 60 × 64 pixels, others have 64 × 64$/,
  );
  await page.upload(AVIF_BALLS);
  await tab.waitForSelector("#crop-words", { state: "hidden" });
});

test("photographs of 16 bits are not cropped, and the page says why", async () => {
  const deep = /** @type {const} */ (["x", "y", "both"]).map((lit) => {
    const { name, bytes } = greyPng(`${lit}.png`, 32, 32, 200, lit);
    const copy = Uint8Array.from(bytes);
    // Where the header has the bits of a sample.
    copy[24] = 16;
    return { name, bytes: copy };
  });
  await page.upload(deep);
  await tab.waitForSelector("#stack-words:has-text('3 photographs')");
  await tab.click("#crop");
  await tab.waitForSelector("#crop-problem:has-text('only be taken whole: both.png has 16 bits a sample')");
  assert.equal(await tab.isVisible(".crop-editor"), false);
  page.assertQuiet();
});
