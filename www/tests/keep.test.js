import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { unzipSync } from "fflate";
import { complaints } from "./support/axe.js";
import { sampleList } from "./support/files.js";
import { Page } from "./support/page.js";
import { source } from "./support/source.js";

const [statue, relief] = sampleList();
assert.ok(statue && relief);
const scratch = mkdtempSync(join(tmpdir(), "normalight-keep-"));
/** @type {Page} */
let page;
/** @type {import("playwright-core").Page} */
let tab;

before(async () => {
  page = await Page.open({ webgpu: false });
  tab = page.page;
  await page.estimateSample(statue);
  // Nothing below takes long.
  tab.setDefaultTimeout(40_000);
});
after(async () => {
  await page.close();
  rmSync(scratch, { recursive: true });
});

/** Presses a button and takes the file that comes. @param {string} button */
async function given(button) {
  const coming = tab.waitForEvent("download");
  await tab.click(button);
  const download = await coming;
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** Chooses the way green points. @param {"opengl" | "directx"} format */
async function green(format) {
  const before = await tab.getAttribute('#downloads a[download="normals.png"]', "href");
  await tab.click(`label:has(input[name="normal-format"][value="${format}"])`);
  await tab.waitForFunction(
    (address) =>
      document.querySelector('#downloads a[download="normals.png"]')?.getAttribute("href") !== address,
    before,
  );
}

/** The mean green of what the viewer shows of the normals, as its histogram says it. */
async function meanGreen() {
  await tab.waitForTimeout(400);
  return await tab.evaluate(() => {
    const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById("viewer-canvas"));
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", {
      willReadFrequently: true,
    });
    copy?.drawImage(canvas, 0, 0);
    const data = copy?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
    let [sum, count] = [0, 0];
    for (let at = 0; at < data.length; at += 4) {
      if (data[at + 3] !== 255) continue;
      sum += data[at + 1] ?? 0;
      count += 1;
    }
    return sum / count;
  });
}

test("green up or down counts at once, in what is shown and in what is kept", async () => {
  await tab.selectOption("#viewer-map", "normals");
  const up = { shown: await meanGreen(), file: await page.download("normals.png") };
  await green("directx");
  const down = { shown: await meanGreen(), file: await page.download("normals.png") };
  assert.ok(Math.abs(up.shown + down.shown - 255) < 1, `${up.shown} and ${down.shown}`);
  assert.ok(Math.abs(up.shown - down.shown) > 1);
  assert.notDeepEqual(down.file, up.file);
  assert.equal(JSON.parse(String(await page.download("report.json"))).settings.normal_format, "directx");
  assert.match((await tab.locator("#viewer-map option:checked").textContent()) ?? "", /green is down/);
  await green("opengl");
  assert.deepEqual(await page.download("normals.png"), up.file);
  assert.equal(JSON.parse(String(await page.download("report.json"))).settings.normal_format, "opengl");
});

test("depth, mesh and maps are made, offered and shown", async () => {
  await tab.selectOption("#derive-mesh", "glb");
  await tab.check("#derive-maps");
  await tab.check("#derive-flatten");
  await tab.check("#derive-tileable");
  await tab.click("#derive");
  await tab.waitForSelector("#derive-status:has-text('pixels from back to front')");
  const names = await tab
    .locator("#downloads a")
    .evaluateAll((links) => links.map((link) => link.getAttribute("download")));
  for (const name of [
    "normals.npy",
    "height.png",
    "height.exr",
    "mesh.glb",
    "map-normals.png",
    "depth.json",
  ]) {
    assert.ok(names.includes(name), `${name} is not among ${names.join(", ")}`);
  }
  assert.equal(String((await page.download("mesh.glb")).subarray(0, 4)), "glTF");
  assert.equal(await tab.inputValue("#viewer-map"), "depth");
  await tab.waitForSelector("#viewer-spread:has-text('depth')");
  await tab.locator("#viewer-canvas").hover();
  assert.match((await tab.locator("#viewer-values").textContent()) ?? "", /depth.*px/);
});

test("everything is kept as one archive", async () => {
  const { name, bytes } = await given("#zip");
  assert.equal(name, "Stone-cat.zip");
  const files = unzipSync(new Uint8Array(bytes));
  const offered = await tab
    .locator("#downloads a")
    .evaluateAll((links) => links.map((link) => link.getAttribute("download")));
  assert.deepEqual(Object.keys(files), offered);
  assert.deepEqual(Buffer.from(files["normals.png"] ?? []), await page.download("normals.png"));
  assert.equal(JSON.parse(String(Buffer.from(files["report.json"] ?? []))).width, 192);
});

test("the relightable page works from the disk, without network, by pointer, finger and keys", async () => {
  const { name, bytes } = await given("#share");
  assert.equal(name, "Stone-cat.html");
  const path = join(scratch, name);
  writeFileSync(path, bytes);
  const browser = tab.context().browser();
  assert.ok(browser);
  const other = await browser.newPage({
    offline: true,
    viewport: { width: 800, height: 700 },
    hasTouch: true,
  });
  /** @type {string[]} */
  const requests = [];
  /** @type {string[]} */
  const wrong = [];
  other.on("request", (request) => requests.push(request.url().slice(0, 40)));
  other.on("pageerror", (error) => wrong.push(String(error)));
  other.on("console", (message) => {
    if (message.type() === "error") wrong.push(message.text());
  });
  await other.goto(pathToFileURL(path).href);
  const canvas = other.locator("#object");
  await other.waitForTimeout(700);
  const looks = new Set();
  const look = async () => {
    await other.waitForTimeout(150);
    looks.add((await canvas.screenshot()).toString("base64"));
  };
  await look();
  await other.mouse.move(250, 500);
  await look();
  await other.touchscreen.tap(600, 200);
  await look();
  await canvas.press("ArrowDown");
  await look();
  await other.locator("#specular").fill("0.9");
  await look();
  await other.uncheck("#coloured");
  await look();
  assert.equal(looks.size, 6);
  assert.deepEqual(wrong, []);
  assert.deepEqual(
    requests.filter((address) => !/^(file|data):/.test(address)),
    [],
  );
  assert.equal(await other.title(), "Stone cat");
  await other.close();
});

test("a result says of which stack it is, once another one is there", async () => {
  assert.equal(await tab.textContent("#result-title"), "Result of Stone cat");
  assert.equal(await tab.isVisible("#result-stale"), false);
  await page.sample(relief);
  assert.match((await tab.textContent("#result-stale")) ?? "", /^This is the result of Stone cat\./);
  assert.deepEqual(await complaints(tab, "#result"), []);
  tab.setDefaultTimeout(120_000);
  assert.equal(await page.estimate(), "");
  assert.equal(await tab.textContent("#result-title"), "Result of Relief");
  assert.equal(await tab.isVisible("#result-stale"), false);
  assert.equal(await tab.textContent("#relight-words"), "", "the second result is not painted by the GPU");
  assert.equal(await tab.inputValue("#viewer-map"), "relit");
  page.assertQuiet();
});

test("templates are filled, and words stand in them as words", async () => {
  /** @type {typeof import("../src/out/fill.js")} */
  const { escaped, fill } = await source("out/fill.ts");
  assert.equal(fill("<b>{{a}}</b>/*{b}*/{{c}}", { a: "$&", b: "let x;" }), "<b>$&</b>let x;{{c}}");
  assert.equal(escaped('<a href="x">&'), "&#60;a href=&#34;x&#34;&#62;&#38;");
  /** @type {typeof import("../src/downloads.js")} */
  const { fileNameOf, withFormat } = await source("downloads.ts");
  assert.equal(fileNameOf("001.png … 016.png"), "001-016");
  assert.equal(fileNameOf("../ü b"), "ü-b");
  assert.equal(fileNameOf(""), "normalight");
  assert.equal(withFormat('{"normal_format": "opengl"}', "directx"), '{"normal_format": "directx"}');
});
