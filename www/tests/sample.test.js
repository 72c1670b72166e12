import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { sampleList } from "./support/files.js";
import { Page } from "./support/page.js";

const [statue] = sampleList();
assert.ok(statue);
/** @type {Page} */
let page;

before(async () => {
  page = await Page.open({ webgpu: false });
});
after(() => page.close());

test("without WebGPU the page says so and uses the processor", async () => {
  for (const device of /** @type {const} */ (["auto", "gpu"])) {
    assert.equal(await page.device(device), "Ready on the CPU");
    const notice = (await page.page.textContent("#device-notice")) ?? "";
    assert.match(notice, /WebGPU.*so the processor computes/);
  }
  await page.device("cpu");
  assert.equal(await page.page.isVisible("#device-notice"), false);
});

test("a run can be cancelled, and the next one works", async () => {
  await page.sample(statue);
  await page.page.click("#start");
  await page.page.waitForFunction(() => document.querySelector("#stages [data-state=now]") !== null);
  await page.page.click("#cancel");
  await page.page.waitForSelector("#start:visible");
  assert.match((await page.page.textContent("#status")) ?? "", /^Cancelled/);
  assert.equal(await page.page.isVisible("#result"), false);
  assert.equal(await page.page.locator("#thumbnails li").count(), 17);

  assert.equal(await page.estimate(), "");
  assert.match((await page.page.textContent("#status")) ?? "", /^Done in/);
});

test("the sample's result is shown", async () => {
  const { page: tab } = page;
  assert.match((await tab.textContent("#facts")) ?? "", /16 of 192 × 192 pixels.*CPU.*default/);
  assert.equal(await tab.locator("#lights tr").count(), 16);
  assert.equal(await tab.locator("#light-map circle title").count(), 16);
  assert.match((await tab.textContent("#seconds")) ?? "", /reading.*lights.*normals.*refit.*albedo/);
  for (const map of ["relit", "normals", "albedo"]) {
    await tab.selectOption("#viewer-map", map);
    await tab.waitForFunction(() => (document.getElementById("viewer-spread")?.textContent ?? "") !== "");
    assert.doesNotMatch((await tab.textContent("#viewer-spread")) ?? "", /no pixels/, `${map} is empty`);
  }
  page.assertQuiet();
});
