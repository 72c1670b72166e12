import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { AVIF_BALLS } from "./support/avif.js";
import { complaints } from "./support/axe.js";
import { greyPng } from "./support/files.js";
import { Page } from "./support/page.js";

/** @type {Page} */
let page;
/** @type {import("playwright-core").Page} */
let tab;
/** Another stack. */
const others = /** @type {const} */ (["x", "y", "both"]).map((lit) =>
  greyPng(`${lit}.png`, 32, 32, 200, lit),
);

before(async () => {
  page = await Page.open({ webgpu: false });
  tab = page.page;
});
after(() => page.close());

/** What the browser keeps: the names of the parts, and how much of some. */
function kept() {
  return tab.evaluate(
    () =>
      new Promise((resolve, reject) => {
        const opening = indexedDB.open("normalight.session");
        opening.onerror = () => reject(opening.error);
        opening.onsuccess = () => {
          const parts = opening.result.transaction("parts").objectStore("parts");
          const [keys, stack, hand] = [parts.getAllKeys(), parts.get("stack"), parts.get("hand")];
          hand.onsuccess = () => {
            opening.result.close();
            const names = keys.result.map(String).filter((name) => !name.startsWith("file "));
            const files = keys.result.length - names.length;
            const counts = [stack.result?.files, hand.result?.left].map((list) => list?.length ?? 0);
            resolve(`${names.join(", ")}; ${files} files, ${counts[0]} in the stack, ${counts[1]} left out`);
          };
        };
      }),
  );
}

/** Waits until the browser keeps this. @param {string} expected */
async function keeps(expected) {
  const end = Date.now() + 240_000;
  while ((await kept()) !== expected && Date.now() < end);
  assert.equal(await kept(), expected);
}

/** A reload after which something is offered; its words. */
async function offer() {
  await tab.reload();
  await tab.waitForSelector("#session:visible");
  assert.equal(await tab.isVisible("#stack"), false, "photographs are put back unasked");
  return await tab.textContent("#session-words");
}

test("photographs, mask, settings, result and lights set by hand survive a reload", async () => {
  await page.quick();
  await tab.click('label:has(input[name="normal-format"][value="directx"])');
  await page.upload(AVIF_BALLS);
  await page.thumbnails(4);
  await tab.waitForSelector("#stack-kept:has-text('Kept on this device')");
  await tab.click("#mask-edit");
  await tab.click('dialog [data-do="frame"]');
  await tab.click('dialog [data-do="done"]');
  await tab.waitForSelector('#mask-name:text-is("Drawn")');
  assert.equal(await page.estimate(), "");
  await tab.focus('.dot[aria-selected="true"]');
  await tab.keyboard.press("Shift+ArrowUp");
  await tab.keyboard.press("Delete");
  const hand = await tab.textContent(".light-words");
  assert.equal(hand, "1 light changed, 1 photograph left out");
  const normals = await page.download("normals.png");
  const facts = await tab.textContent("#facts");
  await keeps("hand, outcome, settings, stack; 4 files, 4 in the stack, 1 left out");

  assert.match(
    (await offer()) ?? "",
    /^Go on with ball_1\.avif … ball_4\.avif \(4 photographs, from \d\d:\d\d\)$/,
  );
  assert.match((await tab.textContent("#session")) ?? "", /Kept on this device only\./);
  assert.deepEqual(await complaints(tab, "#session"), []);
  assert.equal(await tab.inputValue('input[name="quality"]:checked'), "default");
  await tab.click("#session-restore");
  await page.thumbnails(4);
  assert.equal(await tab.isVisible("#session"), false);
  assert.equal(await tab.inputValue('input[name="quality"]:checked'), "fast");
  assert.equal(await tab.inputValue('input[name="normal-format"]:checked'), "directx");
  assert.equal(await tab.inputValue('input[name="mask"]:checked'), "file");
  assert.equal(await tab.textContent("#mask-name"), "Drawn");
  assert.equal(await tab.textContent("#facts"), facts);
  assert.equal(await tab.isVisible("#result-stale"), false);
  assert.deepEqual(await page.download("normals.png"), normals);
  assert.equal(await tab.textContent(".light-words"), hand);
  await tab.waitForSelector(".light-detail > canvas");
  page.assertQuiet();
});

test("what was restored is changed and kept again, without files that are gone", async () => {
  await tab.click("#thumbnails li:first-child .remove");
  await page.thumbnails(3);
  // The result still needs it.
  await keeps("hand, outcome, settings, stack; 4 files, 3 in the stack, 1 left out");
  assert.match((await offer()) ?? "", /\(3 photographs/);
  await tab.click("#session-restore");
  await page.thumbnails(3);
  assert.equal(await tab.isVisible("#result-stale"), true);
});

test("one session is kept: another stack takes its place, whether the offer was answered or not", async () => {
  await page.upload(others);
  await keeps("settings, stack; 3 files, 3 in the stack, 0 left out");
  assert.match((await offer()) ?? "", /^Go on with both\.png … x\.png/);
  await page.ready();
  await page.upload(AVIF_BALLS);
  await keeps("settings, stack; 4 files, 4 in the stack, 0 left out");
  assert.equal(await tab.isVisible("#session"), false);
  assert.match((await offer()) ?? "", /^Go on with ball_1/);
});

test("Forget and Clear leave nothing behind", async () => {
  await tab.click("#session-forget");
  assert.equal(await tab.isVisible("#session"), false);
  await keeps("; 0 files, 0 in the stack, 0 left out");
  await page.ready();
  await page.upload(others);
  await keeps("settings, stack; 3 files, 3 in the stack, 0 left out");
  await tab.click("#clear");
  await keeps("; 0 files, 0 in the stack, 0 left out");
});

test("a second window neither offers nor replaces what the first one keeps", async () => {
  await page.upload(others);
  await keeps("settings, stack; 3 files, 3 in the stack, 0 left out");
  const second = new Page(await tab.context().newPage(), async () => {});
  await second.page.goto(tab.url());
  await second.ready();
  await second.upload(AVIF_BALLS);
  await second.page.waitForSelector("#stack-kept:has-text('Another window')");
  assert.equal(await second.page.isVisible("#session"), false);
  await keeps("settings, stack; 3 files, 3 in the stack, 0 left out");
  await second.page.close();
});

test("a browser without room says so, and the estimate goes on", async () => {
  await tab.click("#clear");
  await tab.evaluate(() => {
    IDBObjectStore.prototype.put = () => {
      throw new DOMException("no", "QuotaExceededError");
    };
  });
  await page.upload(AVIF_BALLS);
  await tab.waitForSelector("#stack-kept:has-text('not kept for a reload: this browser has no room left.')");
  await page.quality("fast");
  assert.equal(await page.estimate(), "");
  await keeps("; 0 files, 0 in the stack, 0 left out");
  page.assertQuiet();
});
