import assert from "node:assert/strict";
import { test } from "node:test";
import { greyPng, hugePng, squareMask } from "./support/files.js";
import { quickPage } from "./support/page.js";

/** @typedef {import("./support/files.js").TestFile} TestFile */

const SIDE = 2000;
/** Photographs of four megapixels. @type {TestFile[]} */
const large = [
  greyPng("001.png", SIDE, SIDE, 255, "squares"),
  greyPng("002.png", SIDE, SIDE, 200, "y"),
  greyPng("003.png", SIDE, SIDE, 200, "both"),
];
const page = await quickPage();
const tab = page.page;

test("what large photographs cost is said, and they are taken at a quarter of their size", async () => {
  await page.upload([...large, squareMask(SIDE / 4, 24)]);
  await tab.waitForSelector(
    '#large-words:has-text("3 photographs of 4.0 megapixels: about 0.9 GB of memory; about 2 min")',
  );
  assert.ok(await tab.isChecked('input[name="size"][value="1"]'));
  await page.thumbnails(large.length + 1);
  await tab.click('label:has(input[name="size"][value="4"])');
  await tab.waitForSelector('#large-words:has-text("3 photographs of 0.3 megapixels: about 0.4 GB")');
  assert.equal(await page.estimate(), "");
  const words = "at a quarter of their size, from 2000 × 2000 pixels";
  assert.ok((await tab.textContent("#facts"))?.includes(`3 of 500 × 500 pixels, ${words}`));
  assert.ok((await tab.textContent("#plan"))?.includes(words));
  assert.equal(JSON.parse(String(await page.download("report.json"))).photographs_taken, words);
  assert.match((await tab.textContent("#large-words")) ?? "", /as fast as the last run was/);
  assert.ok(await tab.isHidden("#result-stale"));
  // Photographs beside the result are those that were used.
  await tab.selectOption("#viewer-map", "residual");
  await tab.waitForSelector("#viewer-spread:has-text('difference in %')");
  // Black and white pixels in turns: the mean of their light is 188 of sRGB, that of their codes 128.
  await tab.selectOption("#viewer-map", "photograph-0");
  await tab.waitForSelector(
    "#viewer-spread:text-matches('^red 188 to 188, .*green 188 to 188, .*blue 188 to 188, ')",
  );
});

test("what a part of them costs is said, and the part is taken at half its size, of a small mask too", async () => {
  await tab.click("#crop");
  for (const [side, pixels] of Object.entries({ left: 880, top: 900, width: 301, height: 200 }))
    await tab.fill(`[name="crop-${side}"]`, String(pixels));
  await tab.click('.crop-editor [data-do="done"]');
  await tab.click('label:has(input[name="size"][value="2"])');
  await tab.waitForSelector(
    '#large-words:has-text("3 photographs of 0.0 megapixels after cropping: about 0.4 GB")',
  );
  assert.equal(await page.estimate(), "");
  const words =
    "cropped to 301 × 200 pixels, 880 from the left and 900 from the top, at half their size, from 2000 × 2000 pixels";
  const facts = (await tab.textContent("#facts")) ?? "";
  assert.ok(facts.includes(`3 of 151 × 100 pixels, ${words}`), facts);
  // The square of 47 pixels in the small mask is 188 pixels wide, and 94 at half the size.
  const [, pixels = ""] = /mask\.png, ([\d,]+) pixels/.exec(facts) ?? [];
  assert.ok(Math.abs(Number(pixels.replace(",", "")) - 94 * 94) < 250, facts);
});

test("photographs for which there is no memory are made smaller unasked, and small ones are not asked about", async () => {
  await page.upload(["1.png", "2.png", "3.png"].map((name) => hugePng(name)));
  await tab.waitForSelector('#large-why:has-text("More memory than there is for a page (4.0 GB)")');
  assert.ok(await tab.isChecked('input[name="size"][value="4"]'));
  await tab.click('label:has(input[name="size"][value="1"])');
  await tab.waitForSelector('#large-why:has-text("the run may fail")');
  await page.upload(
    ["x", "y", "both"].map((lit) => greyPng(`${lit}.png`, 32, 32, 200, /** @type {"x"} */ (lit))),
  );
  await page.thumbnails(3);
  await tab.waitForSelector("#large", { state: "hidden" });
});

test("photographs of 16 bits are only taken whole, and the page says why", async () => {
  const deep = large.map(({ name, bytes }) => {
    const copy = Uint8Array.from(bytes);
    // Where the header has the bits of a sample.
    copy[24] = 16;
    return { name, bytes: copy };
  });
  await page.upload(deep);
  await tab.waitForSelector('#large-why:has-text("only be taken whole: 001.png has 16 bits a sample")');
  assert.ok(await tab.isDisabled('input[name="size"][value="2"]'));
  assert.ok(await tab.isChecked('input[name="size"][value="1"]'));
  page.assertQuiet();
});
