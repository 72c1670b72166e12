import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { goldenStack, greyPng, hugePng } from "./support/files.js";
import { Page } from "./support/page.js";

/** @typedef {import("./support/files.js").TestFile} TestFile */

const golden = goldenStack();
/** @type {Page} */
let page;

before(async () => {
  page = await Page.open({ webgpu: false });
});
after(() => page.close());

const text = new TextEncoder();
/** Three photographs under three lamps. */
const three = /** @type {const} */ (["x", "y", "both"]).map((lit, index) =>
  greyPng(`${index + 1}.png`, 32, 32, 200, lit),
);
const [first] = golden;
assert.ok(first);

/** What is wrong, the files, and what the page must say. @type {[string, TestFile[], RegExp][]} */
const cases = [
  [
    "not an image",
    [...three, { name: "4.png", bytes: text.encode("hello") }],
    /4\.png: found content that is not PNG/,
  ],
  ["an empty file", [...three, { name: "4.png", bytes: new Uint8Array() }], /4\.png: found an empty file/],
  [
    "a truncated file",
    [{ ...first, bytes: first.bytes.slice(0, 900) }, ...three],
    /001\.png: expected a complete PNG/,
  ],
  [
    "images of different sizes",
    [...three, ...[4, 5, 6].map((number) => greyPng(`${number}.png`, 40, 32, 200))],
    /4\.png: 40x32 pixels/,
  ],
  ["black images", three.map(({ name }) => greyPng(name, 32, 32, 0)), /black inside the mask/],
  ["an empty mask", [...three, greyPng("mask.png", 32, 32, 0)], /mask\.png: the mask is empty/],
  [
    "a mask of another shape",
    [...three, greyPng("mask.png", 12, 8, 255)],
    /mask\.png: the mask has 12x8 pixels/,
  ],
  ["images of one pixel", three.map(({ name }) => greyPng(name, 1, 1, 200)), /1\.png: 1x1 pixels/],
  ["too many pixels", [...three, hugePng("4.png")], /4\.png: 20000x20000 pixels, at most/],
  [
    "a list with a missing file",
    [...three, { name: "filenames.txt", bytes: text.encode("9.png\n") }],
    /9\.png/,
  ],
];

for (const [what, files, expected] of cases) {
  test(`${what}: the page says so`, async () => {
    await page.upload(files);
    assert.match((await page.estimate()) ?? "", expected);
  });
}

test("no image at all: the page says so before a run", async () => {
  await page.upload([{ name: "notes.docx", bytes: text.encode("hello") }]);
  await page.page.waitForSelector("#start-why:text('There is no photograph among these files')");
  assert.match((await page.page.textContent("#stack-notes")) ?? "", /notes\.docx/);
  assert.ok(await page.page.isDisabled("#start"));
});

test("a wrong extension: the content decides", async () => {
  await page.upload([...three, greyPng("4.jpg", 32, 32, 140, "both")]);
  assert.equal(await page.estimate(), "");
  assert.match((await page.page.textContent("#facts")) ?? "", /4 of 32 × 32 pixels/);
});

test("a light file with too few rows: the page says so", async () => {
  await page.upload(three);
  await page.choose("lights", { name: "lights.txt", bytes: text.encode("0 0 1\n0 1 1\n") });
  assert.match((await page.estimate()) ?? "", /lights\.txt: 2 lights, but 3 are expected/);
  await page.page.click('label:has(input[name="lights"][value="auto"])');
});

test("a chosen mask of another shape: the page says so", async () => {
  await page.upload(three);
  await page.choose("mask", greyPng("chosen.png", 12, 8, 255));
  assert.match((await page.estimate()) ?? "", /chosen\.png: the mask has 12x8 pixels/);
  await page.page.click('label:has(input[name="mask"][value="auto"])');
});

test("a bad file is marked, the others are kept, and without it all is well", async () => {
  const broken = golden.map((file) => (file === first ? { ...file, bytes: file.bytes.slice(0, 900) } : file));
  await page.upload(broken);
  await page.thumbnails(golden.length);
  assert.match((await page.page.textContent("#file-problems")) ?? "", /^001\.png: expected a complete PNG/);
  assert.equal(await page.page.locator('#thumbnails [data-state="bad"]').count(), 1);
  await page.page.click('[aria-label="Remove 001.png"]');
  await page.page.waitForSelector("#file-problems", { state: "hidden" });
  assert.equal(await page.estimate(), "");
  assert.match((await page.page.textContent("#facts")) ?? "", /11 of 92 × 92 pixels/);
  page.assertQuiet();
});
