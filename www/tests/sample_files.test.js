import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { greyPng, sampleFolder, sampleList } from "./support/files.js";
import { Page } from "./support/page.js";

const samples = sampleList();
/** @type {Page} */
let page;

before(async () => {
  page = await Page.open({ webgpu: false });
});
afterEach(() => page.page.unrouteAll({ behavior: "ignoreErrors" }));
after(() => page.close());

const [statue, relief] = samples;
assert.ok(statue && relief);

/** What is in the way of one file, and what the page must say. @type {[string, (route: import("playwright-core").Route) => Promise<void>, RegExp][]} */
const cases = [
  ["is missing", (route) => route.fulfill({ status: 404, body: "not found" }), /404 Not Found/],
  [
    "is answered with a page",
    (route) => route.fulfill({ contentType: "text/html", body: "<p>hello" }),
    /web page/,
  ],
  ["does not arrive", (route) => route.abort(), /no connection/],
];

test("every sample is there with all its files", () => {
  assert.deepEqual(
    samples.map(({ name }) => name),
    ["statue", "relief", "glossy"],
  );
  for (const { name, photographs, mask } of samples) {
    const files = new Set(sampleFolder(name).map((file) => file.name));
    assert.deepEqual(
      [...photographs, mask].filter((file) => !files.has(file)),
      [],
    );
    assert.equal(photographs.length, 16);
  }
});

test("the choice shows a picture and words of every sample", async () => {
  const { page: tab } = page;
  assert.equal(await tab.locator(".sample").count(), samples.length);
  for (const { name, title } of samples) {
    const button = tab.locator(`[data-sample="${name}"]`);
    assert.match((await button.textContent()) ?? "", new RegExp(title));
    await button.scrollIntoViewIfNeeded();
    const picture = button.locator('img[loading="lazy"]');
    await picture.evaluate((image) => /** @type {HTMLImageElement} */ (image).decode());
  }
  page.assertQuiet();
});

test("a sample is chosen with the keyboard, and another after it", async () => {
  const { page: tab } = page;
  for (const { name, photographs } of [statue, relief]) {
    await tab.focus(`[data-sample="${name}"]`);
    await tab.keyboard.press("Enter");
    await tab.waitForSelector(`[data-sample="${name}"][aria-current="true"]`);
    await page.thumbnails(photographs.length + 1);
    assert.equal(await tab.locator(".sample[aria-current]").count(), 1);
  }
  page.assertQuiet();
});

test("a sample says itself how its values relate to light, until the user's files come", async () => {
  const { page: tab } = page;
  const color = () => tab.locator('input[name="color"]:checked').getAttribute("value");
  await tab.click("#clear");
  await tab.click('label:has(input[name="color"][value="srgb"])');
  await page.sample(statue);
  assert.equal(await color(), statue.color);
  await page.sample(relief);
  assert.equal(await color(), relief.color);
  await page.upload(["1.png", "2.png", "3.png"].map((name) => greyPng(name, 32, 32, 200)));
  await page.thumbnails(3);
  assert.equal(await color(), "srgb");
  assert.equal(await tab.locator(".sample[aria-current]").count(), 0);
  await tab.click('label:has(input[name="color"][value="auto"])');
  page.assertQuiet();
});

test("the fetching of a sample shows its progress and can be cancelled", async () => {
  const { page: tab } = page;
  await page.upload(["1.png", "2.png", "3.png"].map((name) => greyPng(name, 32, 32, 200)));
  await page.thumbnails(3);
  // Never answered: the page waits for this one file.
  await tab.route("**/samples/statue/007.png", () => {});
  await tab.click('[data-sample="statue"]');
  assert.equal(await tab.textContent("#sample-words"), `Fetching ${statue.title}`);
  await tab.waitForFunction(
    (expected) => {
      const bar = /** @type {HTMLProgressElement} */ (document.getElementById("sample-bar"));
      return Math.abs(bar.value - expected) < 1e-6;
    },
    statue.photographs.length / (statue.photographs.length + 1),
  );
  await tab.focus("#sample-cancel");
  await tab.keyboard.press("Enter");
  await tab.waitForSelector("#sample-progress", { state: "hidden" });
  assert.equal(await tab.evaluate(() => document.activeElement?.getAttribute("data-sample")), "statue");
  assert.equal(await tab.isVisible("#sample-problem"), false);
  assert.equal(await tab.textContent("#stack-words"), "3 photographs");
});

for (const [what, answer, expected] of cases) {
  test(`a sample whose file ${what}: the page says so, keeps what it has, and tries again`, async () => {
    const { page: tab } = page;
    await page.upload(["1.png", "2.png", "3.png"].map((name) => greyPng(name, 32, 32, 200)));
    await page.thumbnails(3);
    await tab.route("**/samples/statue/007.png", answer);
    await tab.click('[data-sample="statue"]');
    await tab.waitForSelector("#sample-problem:visible");
    const problem = (await tab.textContent("#sample-problem")) ?? "";
    assert.match(problem, /^The sample's file statue\/007\.png cannot be fetched: /);
    assert.match(problem, expected);
    assert.equal(await tab.isVisible("#sample-progress"), false);
    assert.equal(await tab.textContent("#stack-words"), "3 photographs");

    await tab.unrouteAll({ behavior: "ignoreErrors" });
    await page.sample(statue);
    assert.equal(await tab.isVisible("#sample-problem"), false);
  });
}

test("a list of samples that is missing: the page says so, and works without", async () => {
  const { page: tab } = page;
  await tab.route("**/samples/samples.json", (route) => route.fulfill({ status: 404, body: "not found" }));
  await tab.reload();
  await tab.waitForSelector("#sample-problem:visible");
  assert.match((await tab.textContent("#sample-problem")) ?? "", /samples\.json cannot be fetched: 404/);
  assert.equal(await tab.locator(".sample").count(), 0);
  await page.ready();
  await page.upload(["1.png", "2.png", "3.png"].map((name) => greyPng(name, 32, 32, 200)));
  await page.thumbnails(3);
});
