// A new version of the page beside one that is kept in the browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
// Playwright looks into service workers; puppeteer can leave them alone, so that they come and go as for people.
import puppeteer from "puppeteer-core";
import { Host } from "./support/host.js";
import { QUIET } from "./support/page.js";

const STACK = ["001", "005", "009"].map(
  (name) => `${import.meta.dirname}/../public/samples/statue/${name}.png`,
);

/** @type {Host} */
let host;
/** @type {import("puppeteer-core").Browser} */
let browser;
/** @type {import("puppeteer-core").Page} */
let tab;

before(async () => {
  const { NORMALIGHT_CHROMIUM: executablePath = "" } = process.env;
  assert.ok(executablePath, "NORMALIGHT_CHROMIUM names no browser");
  host = await Host.start();
  browser = await puppeteer.launch({
    executablePath,
    args: QUIET,
    targetFilter: (target) => target.type() !== "service_worker",
  });
  tab = await open();
});
after(async () => {
  await browser.close();
  host.close();
});

/** A window with the page. */
async function open() {
  const page = await browser.newPage();
  page.setDefaultTimeout(120_000);
  await page.goto(host.address);
  return page;
}

/** @param {string} words */
async function versionSays(words) {
  const said = (/** @type {string} */ words) => {
    const version = document.getElementById("version");
    return version?.hidden === false && version.textContent?.includes(words);
  };
  await tab.waitForFunction(said, {}, words);
}

/** @param {string} title */
async function titled(title) {
  await tab.waitForFunction((title) => document.title === title, {}, title);
}

/** Puts another version on the server, for which the browser looks now rather than some time after a visit. @param {string} title */
async function newBuild(title) {
  // The page listens for other versions by then; what a window finds waiting when it begins, it takes at once.
  await tab.waitForFunction(() => document.getElementById("offline-words")?.hidden === false);
  await host.build(title);
  await tab.evaluate(async () => {
    const registration = await navigator.serviceWorker.ready;
    // The browser looks by itself after a visit, too. A look that has begun by then answers for this one, though it may have
    // read the version before.
    const found = () => registration.installing ?? registration.waiting;
    for (let looks = 0; looks < 50 && !found(); looks++) await registration.update();
    if (!found()) throw new Error("the browser finds no new version");
  });
}

test("a new version is told of while nothing is lost, and replaces the one before as a whole", async () => {
  await tab.waitForFunction(() => navigator.serviceWorker.controller !== null);
  await newBuild("Second");
  await versionSays("A new version is here: reload to use it.");
  assert.equal(await tab.title(), "Normalight");

  // Photographs on the bench would be lost.
  const input = /** @type {import("puppeteer-core").ElementHandle<HTMLInputElement>} */ (
    await tab.$("#files")
  );
  await input.uploadFile(...STACK);
  await tab.waitForSelector("#version", { hidden: true });
  await tab.waitForSelector("#clear", { visible: true });
  await tab.click("#clear");
  await versionSays("A new version is here: reload to use it.");

  const second = await open();
  assert.equal(await second.title(), "Normalight", "a second window mixes versions");
  await tab.bringToFront();
  await tab.click("#version-reload");
  await versionSays("Other windows still use the one before");
  await second.close();
  await tab.click("#version-reload");
  await titled("Second");
  assert.equal(await tab.$eval("#version", (version) => /** @type {HTMLElement} */ (version).hidden), true);

  // A reload by other means counts as one.
  await newBuild("Third");
  await versionSays("A new version is here");
  await tab.reload();
  await titled("Third");
  const pages = await tab.evaluate(async () => {
    const [name = ""] = await caches.keys();
    const kept = await (await caches.open(name)).keys();
    return kept.filter(({ url }) => url.includes("index.html")).length;
  });
  assert.equal(pages, 1);
  await tab.waitForSelector('#engine[data-state="ready"]');
});
