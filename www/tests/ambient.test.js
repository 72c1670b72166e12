import assert from "node:assert/strict";
import { test } from "node:test";
import { greyPng } from "./support/files.js";
import { quickPage } from "./support/page.js";

/** @typedef {import("./support/files.js").TestFile} TestFile */

const text = new TextEncoder();
/** Lamps from four sides, and the room alone as 003.png. @type {TestFile[]} */
const capture = [
  greyPng("001.png", 48, 48, 200, "x"),
  greyPng("002.png", 48, 48, 200, "y"),
  greyPng("003.png", 48, 48, 20),
  greyPng("004.png", 48, 48, 200, "both"),
  greyPng("005.png", 48, 48, 120, "x"),
];
const page = await quickPage();
const tab = page.page;

/** The plan of a run, which must succeed. */
async function plan() {
  assert.equal(await page.estimate(), "");
  return JSON.parse(String(await page.download("report.json"))).plan;
}

/** @param {string} words */
const says = (words) => tab.waitForSelector(`#ambient-words:has-text("${words}")`);

test("a photograph is marked as taken without the lamp, and subtracted", async () => {
  await page.upload(capture);
  await page.thumbnails(capture.length);
  await tab.selectOption("#ambient", { label: "003.png" });
  await tab.waitForSelector('#stack-words:text("4 photographs · without the lamp 003.png")');
  await says("The light in 003.png is subtracted");
  assert.equal(await tab.locator("#thumbnails .ambient .room:visible").count(), 1);
  const { photographs, ambient } = await plan();
  assert.deepEqual(photographs, ["001.png", "002.png", "004.png", "005.png"]);
  assert.equal(ambient, "(ambient) 003.png");
  assert.match((await tab.locator("#plan").textContent()) ?? "", /\(ambient\) 003\.png/);
  assert.ok(await tab.isHidden("#result-stale"));
});

test("the mark goes with its photograph, and with other photographs", async () => {
  await tab.focus('[aria-label="Remove 003.png"]');
  await tab.keyboard.press("Delete");
  await tab.waitForSelector('#stack-words:text-is("4 photographs")');
  assert.equal(await tab.inputValue("#ambient"), "none");
  await page.upload(capture);
  await tab.waitForSelector("#ambient option:text('003.png')", { state: "attached" });
  await tab.selectOption("#ambient", { label: "003.png" });
  await tab.waitForSelector('#stack-words:text("without the lamp")');
  await page.upload(capture.slice(0, 4));
  await tab.waitForSelector('#stack-words:text-is("4 photographs")');
  assert.equal(await tab.inputValue("#ambient"), "none");
});

test("one that says so in its name is left out in words, or found", async () => {
  const named = capture.map((file) => (file.name === "003.png" ? { ...file, name: "dark.png" } : file));
  await page.upload(named);
  await says("By its name dark.png is one; as long as you say that there is none, it is left out.");
  await page.thumbnails(named.length);
  await tab.selectOption("#ambient", "auto");
  await says("The light in dark.png is subtracted");
  assert.equal((await plan()).ambient, "dark.png");
});

test("a list that names the marked photograph does not stand in the way", async () => {
  const list = { name: "filenames.txt", bytes: text.encode(capture.map(({ name }) => name).join("\n")) };
  await page.upload([...capture, list]);
  await page.thumbnails(capture.length);
  await tab.selectOption("#ambient", { label: "003.png" });
  await tab.waitForSelector('#stack-words:text("4 photographs · without the lamp 003.png")');
  const { photographs, ambient } = await plan();
  assert.ok(!photographs.includes("003.png"), photographs.join(", "));
  assert.equal(ambient, "(ambient) 003.png");
  page.assertQuiet();
});
