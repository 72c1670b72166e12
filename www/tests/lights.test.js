import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { sampleFolder } from "./support/files.js";
import { Page } from "./support/page.js";

const files = sampleFolder("statue").filter(({ name }) => /^\d+\.png$|mask/.test(name));
/** @type {Page} */
let page;

/** Of the help for photographing, before there is a result. @type {(string | null)[]} */
let captions = [];

before(async () => {
  page = await Page.open({ webgpu: false });
  captions = await page.page.locator("#capture-lamps figcaption").allTextContents();
  await page.quality("fast");
  await page.upload(files);
  await page.thumbnails(17);
  assert.equal(await page.estimate(), "");
});
after(() => page.close());

const tab = () => page.page;
const words = () => tab().textContent(".light-words");

/** Where a light is on the screen. @param {number} index */
async function dotAt(index) {
  const box = await tab().locator(`.dot[data-light="${index}"]`).boundingBox();
  assert.ok(box);
  return /** @type {const} */ ([box.x + box.width / 2, box.y + box.height / 2]);
}

test("good and bad places of the lamp are shown, with the words of the check", async () => {
  assert.match(captions[0] ?? "", /^✓ All around/);
  assert.match(captions[1] ?? "", /^✗ From one side.*All lamps came from the left/);
  assert.match(captions[2] ?? "", /^✗ Beside the camera.*All lamps lie within \d+ degrees/);
  assert.match(captions[3] ?? "", /^✗ Grazing.*The lamps graze the object/);
});

test("lights from all around leave nothing to say, those from one side do", async () => {
  assert.equal(await tab().isVisible("#light-coverage"), false);
  const used = tab().locator('[name="light-used"]');
  for (const [index, x] of (await tab().locator("#lights tr td:nth-child(2)").allTextContents()).entries()) {
    if (x.startsWith("−")) continue;
    await tab().click(`#lights tr:nth-child(${index + 1}) .light-name`);
    await used.uncheck();
  }
  await tab().waitForSelector("#light-coverage li:text('All lamps came from the left')");
  await tab().click("#lights-undo");
  assert.equal(await tab().isVisible("#light-coverage"), false);
});

test("each light has a dot, a row, and its photograph", async () => {
  assert.equal(await tab().locator("#light-map .dot title").count(), 16);
  assert.equal(await tab().locator("#lights tr").count(), 16);
  await tab().locator("#light-map").scrollIntoViewIfNeeded();
  await tab().mouse.click(...(await dotAt(4)));
  assert.equal(await tab().textContent(".light-detail b"), "005.png");
  assert.match(
    (await tab().textContent(".light-detail p span")) ?? "",
    /above the picture; (sure|fairly sure|doubtful), \d+ %/,
  );
  assert.ok(await tab().isVisible(".light-detail canvas"));
  assert.equal(await tab().getAttribute("#lights tr:nth-child(5) .light-name", "aria-pressed"), "true");
  await tab().click("#lights tr:nth-child(8) .light-name");
  assert.equal(await tab().textContent(".light-detail b"), "008.png");
  assert.ok(await tab().isDisabled("#lights-again"));
});

test("keys choose a light, move it, and leave it out", async () => {
  await tab().focus('.dot[aria-selected="true"]');
  await tab().keyboard.press("ArrowRight");
  assert.equal(await tab().textContent(".light-detail b"), "009.png");
  const x = Number(await tab().inputValue('[name="light-x"]'));
  await tab().keyboard.press("Shift+ArrowRight");
  assert.ok(Number(await tab().inputValue('[name="light-x"]')) > x);
  assert.equal(await words(), "1 light changed");
  await tab().keyboard.press("Delete");
  assert.equal(await words(), "1 light changed, 1 photograph left out");
  await tab().click("#lights-undo");
  assert.equal(await words(), "");
  assert.ok(await tab().isDisabled("#lights-again"));
});

test("a dragged light, a typed one and one left out give other normals, without estimating lights", async () => {
  const before = await page.download("normals.npy");
  await tab().locator("#light-map").scrollIntoViewIfNeeded();
  const [x, y] = await dotAt(0);
  await tab().mouse.move(x, y);
  await tab().mouse.down();
  await tab().mouse.move(x + 25, y - 20, { steps: 4 });
  await tab().mouse.up();
  assert.equal(await words(), "1 light changed");
  await tab().click("#lights tr:nth-child(2) .light-name");
  await tab().fill('[name="light-intensity"]', "1.5");
  await tab().fill('[name="light-x"]', "3");
  await tab().locator('[name="light-x"]').blur();
  assert.equal(await words(), "2 lights changed");
  await tab().click("#lights tr:nth-child(3) .light-name");
  await tab().uncheck('[name="light-used"]');
  assert.equal(await words(), "2 lights changed, 1 photograph left out");
  await page.during(() => tab().click("#lights-again"));
  assert.equal(await tab().isVisible("#run-problem"), false);
  assert.match((await tab().textContent("#facts")) ?? "", /15 of 192/);
  assert.equal(/lights \d/.test((await tab().textContent("#seconds")) ?? ""), false);
  assert.notDeepEqual(await page.download("normals.npy"), before);
  // The photograph that was left out can come back.
  assert.equal(await tab().locator("#lights tr").count(), 16);
  assert.equal(await tab().locator("#lights tr.left-out").count(), 1);
  assert.ok(await tab().isDisabled("#lights-again"));
  const csv = (await page.download("lights.csv")).toString("utf8");
  assert.match(csv, /^file,x,y,z,intensity,confidence\n001\.png/);
  assert.equal(csv.trim().split("\n").length, 16);
});

test("fewer than three lights cannot be left", async () => {
  for (let row = 1; row <= 14; row++) {
    await tab().click(`#lights tr:nth-child(${row}) .light-name`);
    await tab().uncheck('[name="light-used"]');
  }
  assert.match((await words()) ?? "", /Three photographs at least/);
  assert.ok(await tab().isDisabled("#lights-again"));
  await tab().click("#lights-undo");
});

test("lights are saved and loaded as .lp, CSV and JSON", async () => {
  for (const name of ["lights.lp", "lights.csv", "lights.json"]) {
    const coming = tab().waitForEvent("download");
    await tab().click(`[data-save="${name}"]`);
    const bytes = await readFile(await (await coming).path());
    await tab().setInputFiles("#hand-file", { name, mimeType: "", buffer: bytes });
    await tab().waitForSelector(`.light-keep .notice:text("Lights of ${name}")`);
    assert.ok(await tab().isEnabled("#lights-again"), name);
    await tab().click("#lights-undo");
  }
  await tab().setInputFiles("#hand-file", { name: "bad.json", mimeType: "", buffer: Buffer.from("[{") });
  await tab().waitForSelector(".light-keep .notice:text('bad.json: it is not complete JSON')");
});

test("a rig is kept, survives a reload, is renamed, used for the next object, and deleted", async () => {
  await tab().click("#rig-keep");
  await tab().waitForSelector(".light-keep .notice:text('Give the rig a name first')");
  await tab().fill("#rig-new", "arch");
  await tab().press("#rig-new", "Enter");
  await tab().waitForSelector(".light-keep .notice:text('Kept: arch, 15 lights')");
  await tab().reload();
  await page.ready();
  await page.quality("fast");
  await tab().click('label:has(input[name="lights"][value="rig"])');
  assert.equal(await tab().locator("#rig-select option").textContent(), "arch (15 lights)");
  await tab().fill("#rig-name", "dome");
  await tab().locator("#rig-name").blur();
  assert.equal(await tab().inputValue("#rig-select"), "dome");
  await page.upload(files);
  await page.thumbnails(17);
  assert.match((await page.estimate()) ?? "", /^The rig dome has 15 lights, but there are 16 photographs/);
  await tab().click('[aria-label="Remove 003.png"]');
  await tab().waitForSelector('#stack-words:text("15 photographs")');
  assert.equal(await page.estimate(), "");
  assert.equal(/lights \d/.test((await tab().textContent("#seconds")) ?? ""), false);
  await tab().click("#rig-delete");
  assert.ok(await tab().isDisabled('input[name="lights"][value="rig"]'));
  assert.ok(await tab().isChecked('input[name="lights"][value="auto"]'));
  page.assertQuiet();
});
