// The page in another engine: Firefox, driven by WebDriver BiDi. Everything else is tested in Chromium.
import assert from "node:assert/strict";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
// Playwright's own Firefox is a patched one that no package holds; puppeteer drives the one that people have. This version is
// the last that runs on Node.js 20.
import puppeteer from "puppeteer-core";
import { serveBuild } from "./support/page.js";

const { NORMALIGHT_FIREFOX: executablePath } = process.env;

/** Milliseconds for a step: Firefox takes a while to start, the more on a busy machine. */
const PATIENCE = 300_000;

/** Photographs of a sample, and its mask. */
const STACK = ["001", "005", "009", "013", "mask"].map((name) =>
  fileURLToPath(new URL(`../public/samples/statue/${name}.png`, import.meta.url)),
);

test("from photographs to a file, a mask and a view in 3D in Firefox", {
  skip: executablePath ? false : "NORMALIGHT_FIREFOX names no Firefox",
}, async (t) => {
  const downloads = await mkdtemp(join(tmpdir(), "normalight-firefox-"));
  const server = await serveBuild();
  const browser = await puppeteer.launch({
    browser: "firefox",
    // With a screen, if need be Xvfb's: without one Firefox on Linux has no WebGL.
    headless: !process.env.DISPLAY,
    executablePath: executablePath ?? "",
    timeout: PATIENCE,
    protocolTimeout: PATIENCE,
    extraPrefsFirefox: {
      "browser.download.dir": downloads,
      "browser.download.folderList": 2,
      "browser.download.useDownloadDir": true,
    },
  });
  t.after(async () => {
    await browser.close();
    await server.close();
    await rm(downloads, { recursive: true });
  });
  const [page = await browser.newPage()] = await browser.pages();
  page.setDefaultTimeout(PATIENCE);
  await page.setViewport({ width: 1280, height: 900 });
  /** @type {string[]} */
  const complaints = [];
  page.on("console", (message) => {
    if (["error", "warn"].includes(message.type())) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  const words = (/** @type {string} */ selector) =>
    page.$eval(selector, ({ textContent }) => textContent ?? "");

  await page.goto(server.address);
  await page.click('label:has(input[name="device"][value="cpu"])');
  await page.waitForSelector('#engine[data-state="ready"]');
  assert.equal(await words("#engine-words"), "Ready on the CPU");

  const files = await page.$("#files");
  await /** @type {import("puppeteer-core").ElementHandle<HTMLInputElement>} */ (files).uploadFile(...STACK);
  await page.waitForFunction(
    (count) => document.querySelectorAll("#thumbnails [data-state=shown]").length === count,
    {},
    STACK.length,
  );

  await page.click("#mask-edit");
  await page.waitForFunction(() => / pixels$/.test(document.querySelector(".mask-words")?.textContent ?? ""));
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.querySelector("dialog[open]") === null);

  await page.click('label:has(input[name="quality"][value="fast"])');
  await page.click("#start");
  await page.waitForSelector("#result:not([hidden])");
  assert.match(await words("#facts"), /4 of 192 × 192 pixels.*CPU.*fast/);

  await page.click('#downloads a[download="lights.csv"]');
  const table = await until(() => readFile(join(downloads, "lights.csv"), "utf8").catch(() => ""));
  assert.match(table, /^file,x,y,z,intensity,confidence\n001\.png,/);

  await page.click("#solid-open");
  const webgl = await page.evaluate(() => document.createElement("canvas").getContext("webgl2") !== null);
  if (webgl) {
    await page.waitForSelector("#solid-canvas");
    const seen = async () => await (await page.$("#solid-canvas"))?.screenshot({ encoding: "base64" });
    const first = await seen();
    await page.focus("#solid-canvas");
    await page.keyboard.press("ArrowLeft");
    await until(async () => (await seen()) !== first);
  } else {
    t.diagnostic("this Firefox has no WebGL2: the view in 3D is tested for saying so");
    await page.waitForFunction(() =>
      /no WebGL2/.test(document.getElementById("solid-words")?.textContent ?? ""),
    );
    assert.match(await words("#relight-words"), /the processor paints/);
  }
  assert.deepEqual(
    complaints.filter((complaint) => webgl || !/WebGL/.test(complaint)),
    [],
  );
});

/** Asks until there is an answer. @template T @param {() => Promise<T>} ask */
async function until(ask) {
  const last = Date.now() + PATIENCE;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    assert.ok(Date.now() < last, "it does not happen");
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}
