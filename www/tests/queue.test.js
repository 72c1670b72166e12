import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { unzipSync } from "fflate";
import { AVIF_BALLS } from "./support/avif.js";
import { complaints } from "./support/axe.js";
import { drop } from "./support/drop.js";
import { greyPng, zipOf } from "./support/files.js";
import { quickPage } from "./support/page.js";

/** @typedef {import("./support/files.js").TestFile} TestFile */

const page = await quickPage();
const tab = page.page;

/** Files in a folder. @param {string} folder @param {TestFile[]} files */
const inFolder = (folder, files) => files.map(({ name, bytes }) => ({ name: `${folder}/${name}`, bytes }));

/** Photographs of different sizes, which cannot be estimated. */
const odd = [20, 30, 40].map((side) => greyPng(`${side}.png`, side, side, 200, "x"));

/** Three captures, of which the second fails; files of the others have the same names. */
const captures = [
  ...inFolder("all/bowl", AVIF_BALLS),
  ...inFolder("all/odd", odd),
  ...inFolder("all/vase", AVIF_BALLS.slice(0, 3)),
];

/** What the list says of a stack. @param {string} name */
const said = (name) => tab.locator(`#queue-list li:has-text("${name}") span`).textContent();

/** The result of the queue that is shown. */
const pressed = () => tab.locator('#queue-list [aria-pressed="true"]').allTextContents();

/** Estimates all and waits for the end. */
async function estimateAll() {
  await page.during(() => tab.click("#estimate-all"));
}

test("all stacks are estimated one after the other, and one that fails says why", async () => {
  await drop(tab, captures);
  await tab.waitForSelector("#estimate-all:text('Estimate all 3')");
  await page.thumbnails(AVIF_BALLS.length);
  // What is set for the stack on the bench goes for it, and where photographs are as large.
  await tab.click("#crop");
  await tab.fill('[name="crop-width"]', "48");
  await tab.click('.crop-editor [data-do="done"]');
  await tab.click("#estimate-all");
  await tab.waitForSelector("#progress-words:has-text('Stack 1 of 3, all/bowl: ')");
  // Three small photographs may be done before anybody looks.
  await tab.waitForSelector("#progress-words:has-text('Stack 3 of 3, all/vase: ')", { state: "attached" });
  await tab.waitForSelector("#start:visible");
  assert.match((await tab.textContent("#status")) ?? "", /^2 of 3 stacks done, 1 failed in \d+ s\.$/);
  assert.match((await said("bowl")) ?? "", /^4 photographs of 48 × 64 pixels, cropped to .*; [\d.]+ s$/);
  assert.match((await said("odd")) ?? "", /^failed: .*\b30/);
  assert.match((await said("vase")) ?? "", /^3 photographs of 48 × 64 pixels, cropped/);
  await tab.waitForSelector("#result-title:text('Result of all/bowl')");
  assert.deepEqual(await complaints(tab, "#queue"), []);
  assert.deepEqual(await complaints(tab, "#bench"), []);
});

test("one can switch between the finished ones; the bench has the stack of the one that is shown", async () => {
  await tab.click('#queue-list button:text("all/vase")');
  await tab.waitForSelector("#result-title:text('Result of all/vase')");
  await tab.waitForSelector("#stack-words:has-text('3 photographs')");
  assert.match((await tab.textContent("#facts")) ?? "", /3 of 48 × 64/);
  assert.equal(await tab.isVisible("#result-stale"), false);
  assert.deepEqual(await pressed(), ["all/vase"]);
  assert.equal(await tab.getAttribute('#folder-others button:has-text("vase")', "aria-pressed"), "true");
  const vase = await page.download("normals.png");
  await tab.click('#queue-list button:text("all/bowl")');
  await tab.waitForSelector("#stack-words:has-text('4 photographs')");
  const bowl = await page.download("normals.png");

  const coming = tab.waitForEvent("download");
  await tab.click("#queue-zip");
  const files = unzipSync(new Uint8Array(await readFile(await (await coming).path())));
  assert.deepEqual(
    [...new Set(Object.keys(files).map((name) => name.split("/")[0]))],
    ["all-bowl", "all-vase"],
  );
  assert.deepEqual(Buffer.from(files["all-bowl/normals.png"] ?? []), bowl);
  assert.deepEqual(Buffer.from(files["all-vase/normals.png"] ?? []), vase);
  assert.ok(files["all-vase/report.json"]);
  // A run of its own is none of the queue.
  assert.equal(await page.estimate(), "");
  assert.deepEqual(await pressed(), []);
});

test("finished results are there again after a reload, with the session", async () => {
  await tab.click('#queue-list button:text("all/vase")');
  await tab.waitForSelector("#result-title:text('Result of all/vase')");
  const vase = await page.download("normals.png");
  const lines = await tab.locator("#queue-list li").allTextContents();
  await tab.waitForSelector("#queue-words:has-text('kept on this device for a reload')");
  // What is shown is kept with them, a moment later.
  await tab.waitForFunction(
    () =>
      new Promise((resolve) => {
        const opening = indexedDB.open("normalight.session");
        opening.onsuccess = () => {
          const reading = opening.result.transaction("parts").objectStore("parts").get("queue");
          reading.onsuccess = () => resolve(reading.result?.shown === 2);
          opening.result.close();
        };
      }),
  );
  // Another language is a reload, too, after which nothing must be asked.
  await tab.selectOption("#language", "de");
  await tab.waitForSelector("#queue-words:text('2 von 3 Sätzen fertig, 1 gescheitert.')");
  assert.match((await said("bowl")) ?? "", /^4 Fotos mit 48 × 64 Pixeln, zugeschnitten auf .*; [\d,]+ s$/);
  assert.match((await tab.textContent("#queue-list span [lang=en]")) ?? "", /\b30/);
  await page.ready();
  await tab.selectOption("#language", "en");
  await tab.waitForSelector("#queue-words:text('2 of 3 stacks done, 1 failed.')");
  assert.deepEqual(await tab.locator("#queue-list li").allTextContents(), lines);
  assert.deepEqual(await pressed(), ["all/vase"]);
  await tab.click('#queue-list button:text("all/bowl")');
  await tab.waitForSelector("#result-title:text('Result of all/bowl')");
  assert.match((await tab.textContent("#facts")) ?? "", /4 of 48 × 64/);
  await tab.waitForSelector("#stack-words:has-text('4 photographs')");
  assert.equal(await tab.isVisible("#result-stale"), false);
  await tab.click('#queue-list button:text("all/vase")');
  await tab.waitForSelector("#result-title:text('Result of all/vase')");
  assert.deepEqual(await page.download("normals.png"), vase);
});

test("results whose photographs find no room are kept until the page is closed, which is said", async () => {
  await page.ready();
  await tab.reload();
  await page.quick();
  await drop(tab, [...inFolder("new/a", AVIF_BALLS), ...inFolder("new/b", AVIF_BALLS)]);
  await tab.waitForSelector("#stack-kept:has-text('Kept on this device for a reload')");
  await tab.evaluate(() => {
    navigator.storage.estimate = async () => ({ quota: 1, usage: 0 });
  });
  await estimateAll();
  await tab.waitForSelector("#queue-words:has-text('no room for all their photographs')");
  assert.equal(await tab.isVisible("#stack-kept"), true);
  await tab.reload();
  await tab.click("#session-restore");
  await page.thumbnails(4);
  assert.equal(await tab.isVisible("#queue"), false);
  await tab.waitForFunction(
    () =>
      new Promise((resolve) => {
        const opening = indexedDB.open("normalight.queue");
        opening.onsuccess = () => {
          const counting = opening.result.transaction("results").objectStore("results").count();
          counting.onsuccess = () => resolve(counting.result === 0);
          opening.result.close();
        };
      }),
  );
});

test("cancelling stops the queue at once, and keeps what is finished", async () => {
  const names = ["1", "2", "3", "4", "5", "6"];
  await page.upload([
    zipOf(
      "captures.zip",
      names.flatMap((name) => inFolder(name, AVIF_BALLS)),
    ),
  ]);
  await tab.waitForSelector(
    "#folder-words:text('6 folders with photographs lie in the archive captures.zip. Taken: 1.')",
  );
  await page.thumbnails(AVIF_BALLS.length);
  await tab.click("#estimate-all");
  await tab.waitForSelector('#queue-list li:nth-child(1)[data-state="done"]');
  // A finished one can be looked at meanwhile.
  await tab.click("#queue-list li:nth-child(1) button");
  await tab.waitForSelector("#result-title:text('Result of 1')");
  await tab.click("#cancel");
  await tab.waitForSelector("#start:visible");
  const states = await tab
    .locator("#queue-list li")
    .evaluateAll((items) => items.map((item) => /** @type {HTMLElement} */ (item).dataset.state));
  // More than the first may have been finished before the click.
  const done = states.lastIndexOf("done") + 1;
  assert.deepEqual(
    states,
    names.map((_, index) => (index < done ? "done" : "cancelled")),
  );
  assert.ok(done >= 1 && done < names.length, states.join());
  const words = `${done} of 6 stacks done in`;
  assert.ok((await tab.textContent("#status"))?.startsWith(words));
  await tab.waitForSelector("#status:has-text('Cancelled; what is finished is kept.')");
  await tab.click("#queue-forget");
  assert.equal(await tab.isVisible("#queue"), false);
});

test("several archives are several stacks; a browser without room keeps results in memory, and says so", async () => {
  await tab.evaluate(() => {
    const put = IDBObjectStore.prototype.put;
    IDBObjectStore.prototype.put = function (...args) {
      if (this.name === "results") throw new DOMException("no", "QuotaExceededError");
      return put.apply(this, args);
    };
  });
  await page.upload([zipOf("a.zip", AVIF_BALLS), zipOf("b.zip", AVIF_BALLS.slice(1))]);
  await tab.waitForSelector("#estimate-all:text('Estimate all 2')");
  await estimateAll();
  assert.match(
    (await tab.textContent("#queue-words")) ?? "",
    /^2 of 2 stacks done\. This browser has no room/,
  );
  await tab.click('#queue-list button:text("b")');
  await tab.waitForSelector("#result-title:text('Result of b')");
  assert.match((await tab.textContent("#facts")) ?? "", /3 of 64 × 64/);
  page.assertQuiet();
});
