import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { AVIF_BALLS } from "./support/avif.js";
import { Host } from "./support/host.js";
import { Page } from "./support/page.js";

/** @type {Host} */
let host;
/** @type {Page} */
let page;
/** @type {import("playwright-core").Page} */
let tab;
/** Of the page, its workers and its service worker. @type {string[]} */
const requests = [];

before(async () => {
  host = await Host.start();
  page = await Page.open({ webgpu: false, offline: true, address: host.address });
  tab = page.page;
  tab.context().on("request", (request) => requests.push(request.url()));
});
after(async () => {
  await page.close();
  host.close();
});

/** A whole way from photographs to a result that is looked at. */
async function wholeEstimate() {
  await page.quick();
  await page.upload(AVIF_BALLS);
  await page.thumbnails(AVIF_BALLS.length);
  assert.equal(await page.estimate(), "");
  await tab.click("#derive");
  await tab.waitForSelector("#derive-status:has-text('pixels from back to front')");
  await page.download("normals.png");
  // Parts of the page that are fetched when they are needed.
  const coming = tab.waitForEvent("download");
  await tab.click("#share");
  await coming;
  await tab.click("#mask-edit");
  await tab.click('dialog [data-do="cancel"]');
}

test("after the first visit a whole estimate works without the server, and asks no other one", async () => {
  await tab.waitForSelector("#offline-words:has-text('works without a network')");
  host.down = true;
  host.asked = 0;
  await tab.reload();
  await page.ready();
  await wholeEstimate();
  const elsewhere = requests.filter((url) => !url.startsWith(host.address) && !/^(blob|data):/.test(url));
  assert.deepEqual(elsewhere, []);
  page.assertQuiet();
  host.down = false;
});

test("the page's policy refuses requests to elsewhere", async () => {
  const other = await Host.start();
  const refused = tab.evaluate(
    () =>
      new Promise((resolve) =>
        addEventListener("securitypolicyviolation", ({ effectiveDirective }) => resolve(effectiveDirective)),
      ),
  );
  const answer = tab.evaluate((url) => fetch(url).then(String, String), `${other.address}icon.svg`);
  assert.match(await answer, /TypeError/);
  assert.equal(await refused, "connect-src");
  assert.equal(other.asked, 0);
  other.close();
});

test("it can be installed", async () => {
  const session = await tab.context().newCDPSession(tab);
  const { installabilityErrors } = await session.send("Page.getInstallabilityErrors");
  // Tests run in private windows.
  assert.deepEqual(
    installabilityErrors.map(({ errorId }) => errorId).filter((id) => id !== "in-incognito"),
    [],
  );
  const { errors, data } = await session.send("Page.getAppManifest");
  assert.deepEqual(errors, []);
  for (const { src, sizes, type } of JSON.parse(data ?? "").icons) {
    if (type !== "image/png") continue;
    const side = await tab.evaluate(async (url) => {
      const image = new Image();
      image.src = url;
      await image.decode();
      return `${image.naturalWidth}x${image.naturalHeight}`;
    }, new URL(src, host.address).href);
    assert.equal(side, sizes);
  }
});

test("without a secure address it works as before, and keeps photographs", async () => {
  const address = host.address.replace("127.0.0.1", "lan.test");
  const args = ["--host-resolver-rules=MAP lan.test 127.0.0.1"];
  const plain = await Page.open({ webgpu: false, offline: true, address, args });
  assert.equal(await plain.page.evaluate(() => "serviceWorker" in navigator), false);
  await plain.upload(AVIF_BALLS);
  await plain.thumbnails(AVIF_BALLS.length);
  await plain.page.waitForSelector("#stack-kept:has-text('Kept on this device')");
  await plain.page.reload();
  await plain.page.waitForSelector("#session:visible");
  plain.assertQuiet();
  await plain.close();
});
