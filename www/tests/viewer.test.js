import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { complaints } from "./support/axe.js";
import { sampleList } from "./support/files.js";
import { Page } from "./support/page.js";

const [statue] = sampleList();
assert.ok(statue);
/** @type {Page} */
let page;
/** @type {import("playwright-core").Page} */
let tab;

before(async () => {
  page = await Page.open({ webgpu: false });
  tab = page.page;
  await page.estimateSample(statue);
  // Nothing below takes long.
  tab.setDefaultTimeout(20_000);
  await tab.waitForSelector("#viewer-map");
});
after(() => page.close());

/** What the viewer shows, as a picture. */
const seen = async () => {
  // Two frames: what was asked for is drawn in the next one.
  await tab.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return (await tab.locator(".viewer-stage").screenshot()).toString("base64");
};
const percent = async () => Number.parseInt((await tab.textContent("#viewer-percent")) ?? "", 10);
const values = async () => (await tab.locator("#viewer-values div").allTextContents()).join("; ");

/** Shows maps. @param {string} main @param {string} other */
async function show(main, other = "") {
  await tab.selectOption("#viewer-map", main);
  await tab.selectOption("#viewer-other", other);
  await tab.waitForSelector("#viewer-status", { state: "hidden" });
}

test("every map is shown, and says how its values are spread", async () => {
  const looks = new Set();
  for (const [map, words] of /** @type {[string, RegExp][]} */ ([
    ["relit", /^red .* green .* blue/],
    ["normals", /^x .*; y .*; z .*/],
    ["albedo", /^red/],
    ["distrust", /^difference in %/],
    ["residual", /^difference in %/],
    ["photograph-3", /^red/],
  ])) {
    await show(map);
    await tab.waitForFunction(
      ([pattern]) =>
        new RegExp(pattern ?? "").test(document.getElementById("viewer-spread")?.textContent ?? ""),
      [words.source],
    );
    looks.add(await seen());
  }
  assert.equal(looks.size, 6);
});

test("the picture is enlarged to its pixels and moved, by buttons, wheel, pointer and keys", async () => {
  await show("normals");
  const canvas = tab.locator("#viewer-canvas");
  const whole = await percent();
  await tab.click("#viewer-in");
  await seen();
  assert.ok((await percent()) > whole);
  await tab.click("#viewer-actual");
  await seen();
  assert.equal(await percent(), 100);
  await tab.click("#viewer-fit");
  await seen();
  assert.equal(await percent(), whole);
  await canvas.hover();
  await tab.mouse.wheel(0, -700);
  await seen();
  const large = await percent();
  assert.ok(large > 3 * whole, `${large} %`);
  const before = await seen();
  await tab.mouse.down();
  await tab.mouse.move(500, 500, { steps: 4 });
  await tab.mouse.up();
  assert.notEqual(await seen(), before, "dragging does not move the picture");
  await canvas.press("0");
  await seen();
  assert.equal(await percent(), whole);
  await canvas.press("+");
  await canvas.press("+");
  const still = await seen();
  await canvas.press("ArrowRight");
  assert.notEqual(await seen(), still, "an arrow key does not move the picture");
  await canvas.press("-");
  await canvas.press("0");
});

test("the values under the pointer are read out, for keys those in the middle", async () => {
  await show("albedo");
  await tab.locator("#viewer-map").focus();
  const box = await tab.locator("#viewer-canvas").boundingBox();
  assert.ok(box);
  await tab.mouse.move(box.x + box.width / 2, box.y + box.height * 0.6);
  assert.match(await values(), /pixel\d+, \d+; normal.*; tilt\d+\.\d°; albedo\d\.\d+ \d/);
  await tab.mouse.move(box.x + box.width / 2 - 0.45 * box.height, box.y + 10);
  assert.match(await values(), /outside the object/);
  await tab.mouse.move(box.x, box.y - 30);
  assert.match(await values(), /Point at the picture/);
  await tab.locator("#viewer-full").focus();
  await tab.keyboard.press("Tab");
  await seen();
  assert.match(await values(), /pixel96, 96; normal/);
});

test("a divider stands between two maps, and is moved by pointer and keys", async () => {
  await show("normals", "albedo");
  const divider = tab.locator("#viewer-split");
  const before = await seen();
  const box = await divider.boundingBox();
  const stage = await tab.locator(".viewer-stage").boundingBox();
  assert.ok(box && stage);
  await tab.mouse.move(box.x + box.width / 2, box.y + 30);
  await tab.mouse.down();
  await tab.mouse.move(stage.x + 0.4 * stage.width, box.y + 30, { steps: 4 });
  await tab.mouse.up();
  assert.equal(await divider.getAttribute("aria-valuenow"), "40");
  assert.notEqual(await seen(), before);
  await divider.press("ArrowRight");
  assert.equal(await divider.getAttribute("aria-valuenow"), "42");
  await divider.press("End");
  await divider.press("PageDown");
  assert.equal(await divider.getAttribute("aria-valuenow"), "90");
  assert.match((await divider.getAttribute("aria-label")) ?? "", /between Normals.* and Albedo/);
});

test("full screen shows the picture alone, and ends again", async () => {
  await tab.click("#viewer-full");
  await tab.waitForFunction(() => document.fullscreenElement?.id === "viewer");
  await tab.click("#viewer-full");
  await tab.waitForFunction(() => document.fullscreenElement === null);
});

test("lamps are dragged on the picture and on the hemisphere, added, dimmed and removed", async () => {
  await show("relit");
  const canvas = tab.locator("#viewer-canvas");
  const first = tab.locator("#lamps .lamp").first();
  const looks = [await seen()];
  const changed = async (/** @type {string} */ what) => {
    const look = await seen();
    assert.ok(!looks.includes(look), `${what} changes nothing`);
    looks.push(look);
  };
  const place = await first.getAttribute("aria-label");
  const box = await canvas.boundingBox();
  assert.ok(box);
  await tab.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.7);
  await tab.mouse.down();
  await tab.mouse.move(box.x + box.width * 0.65, box.y + box.height * 0.6, { steps: 3 });
  await tab.mouse.up();
  assert.notEqual(await first.getAttribute("aria-label"), place);
  await changed("dragging the lamp");
  await canvas.press("ArrowLeft");
  await changed("an arrow key");
  await tab.click("#lamp-add");
  assert.equal(await tab.locator("#lamps .lamp").count(), 2);
  await changed("a second lamp");
  await tab.locator("#lamps .lamp").nth(1).press("ArrowUp");
  await changed("an arrow key on the hemisphere");
  await tab.locator("#lamp-brightness").fill("0.2");
  await changed("the lamp's brightness");
  await tab.locator("#lamps").click({ position: { x: 40, y: 100 } });
  await changed("a click on the hemisphere");
  await tab.click("#lamp-remove");
  assert.equal(await tab.locator("#lamps .lamp").count(), 1);
  assert.ok(await tab.isDisabled("#lamp-remove"));
});

test("the surface is made matt, glossy, rough, hollow or of clay", async () => {
  await show("relit");
  const looks = new Set([await seen()]);
  for (const [slider, value] of /** @type {[string, string][]} */ ([
    ["diffuse", "0.5"],
    ["specular", "0.8"],
    ["gloss", "0.2"],
    ["detail", "3"],
  ])) {
    await tab.locator(`#look-${slider}`).fill(value);
    looks.add(await seen());
  }
  await tab.uncheck("#look-coloured");
  looks.add(await seen());
  await tab.check("#look-flipped");
  looks.add(await seen());
  assert.equal(looks.size, 7);
  assert.equal(await tab.textContent("#look-detail-words"), "3.0 ×");
  await tab.click("#look-reset");
  assert.equal(await tab.inputValue("#look-detail"), "1");
  assert.ok(await tab.isChecked("#look-coloured"));
});

test("photographs are replayed beside the object in their light", async () => {
  const own = await tab.locator("#lamps .lamp").first().getAttribute("aria-label");
  await tab.selectOption("#replay", "2");
  await tab.waitForSelector("#replay-words:has-text('differs from this photograph by')");
  assert.deepEqual(
    [await tab.inputValue("#viewer-map"), await tab.inputValue("#viewer-other")],
    ["relit", "photograph-2"],
  );
  const before = await tab.locator("#lamps .lamp").first().getAttribute("aria-label");
  assert.notEqual(before, own);
  await tab.click("#replay-next");
  await tab.waitForFunction(() => {
    const other = /** @type {HTMLSelectElement | null} */ (document.getElementById("viewer-other"));
    return other?.value === "photograph-3";
  });
  await tab.click("#replay-play");
  await tab.waitForFunction(() => {
    const other = /** @type {HTMLSelectElement | null} */ (document.getElementById("viewer-other"));
    return Number(other?.value.split("-")[1]) > 4;
  });
  await tab.click("#replay-play");
  await tab.selectOption("#replay", "");
  assert.equal(await tab.locator("#lamps .lamp").first().getAttribute("aria-label"), own);
  assert.equal(await tab.inputValue("#viewer-other"), "");
});

test("the result is for everybody: labels, contrast and order, light, dark and narrow", async () => {
  await show("relit", "normals");
  for (const colorScheme of /** @type {const} */ (["light", "dark"])) {
    for (const width of [360, 1280]) {
      await tab.emulateMedia({ colorScheme });
      await tab.setViewportSize({ width, height: 800 });
      assert.deepEqual(await complaints(tab, "#result"), [], `${colorScheme}, ${width} pixels`);
      const wide = await tab.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `${wide} pixels wide at ${width}`);
    }
  }
  page.assertQuiet();
});

test("two fingers enlarge the picture", async () => {
  await tab.setViewportSize({ width: 1280, height: 900 });
  await show("normals");
  await tab.click("#viewer-fit");
  await seen();
  const whole = await percent();
  const box = await tab.locator("#viewer-canvas").boundingBox();
  assert.ok(box);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const fingers = await tab.context().newCDPSession(tab);
  const touch = (/** @type {"touchStart" | "touchMove"} */ type, /** @type {number} */ apart) =>
    fingers.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: [
        { x: x - apart, y, id: 1 },
        { x: x + apart, y, id: 2 },
      ],
    });
  await touch("touchStart", 30);
  for (const apart of [40, 60, 80, 90]) await touch("touchMove", apart);
  await fingers.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await seen();
  assert.ok(Math.abs((await percent()) / whole - 3) < 0.3, `${await percent()} % after ${whole} %`);
});

test("without WebGL2 the processor relights, and the page says that the view in 3D needs it", async () => {
  await tab.addInitScript(() => {
    const before = HTMLCanvasElement.prototype.getContext;
    // @ts-expect-error: one signature for all kinds.
    HTMLCanvasElement.prototype.getContext = function (
      /** @type {string} */ kind,
      /** @type {unknown} */ options,
    ) {
      return kind.startsWith("webgl") ? null : before.call(this, kind, options);
    };
  });
  await tab.reload();
  tab.setDefaultTimeout(120_000);
  await page.ready();
  await page.estimateSample(statue);
  tab.setDefaultTimeout(20_000);
  assert.match((await tab.textContent("#relight-words")) ?? "", /no WebGL2/);
  const before = await seen();
  await tab.locator("#viewer-canvas").press("ArrowRight");
  assert.notEqual(await seen(), before);
  await tab.click("#solid-open");
  await tab.waitForSelector("#solid-words:has-text('This browser has no WebGL2')");
});
