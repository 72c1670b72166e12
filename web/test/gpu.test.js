// A GPU that is missing, or fails: the processor takes over, and says so.
import assert from "node:assert/strict";
import { after, before, beforeEach, test } from "node:test";
import { fileURLToPath } from "node:url";
import { browser } from "./support/browser.js";
import { serve } from "./support/server.js";

const ROOT = fileURLToPath(new URL("../..", import.meta.url));
const GPU_MODULE = "/web/wasm/normalight_gpu_bg.wasm";

/** @type {import("playwright-core").Browser} */
let started;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;
/** @type {import("playwright-core").Page} */
let page;
/** @type {string[]} */
let asked = [];
/** @type {import("./support/server.js").Misbehaviour} */
let misbehave = () => false;

before(async () => {
  server = await serve(ROOT, (path, response) => {
    asked.push(path);
    return misbehave(path, response);
  });
  started = await browser("--enable-unsafe-webgpu");
  page = await started.newPage();
  await page.goto(`${server.url}web/test/support/page.html`);
  await page.waitForFunction(() => "samples" in globalThis);
});
beforeEach(async () => {
  asked = [];
  await page.evaluate(() => {
    globalThis.estimating = false;
  });
  misbehave = () => false;
});
after(async () => {
  await started?.close();
  server?.close();
});

/** Estimates on the GPU; `estimating` is true on the page from the moment the device computes. */
const estimate = () =>
  page.evaluate(async () => {
    /** @type {string[]} */
    const heard = [];
    const onDevice = ({ notice = "" }) => heard.push(notice);
    const normalight = await Normalight.create({ device: "gpu", onDevice });
    const before = normalight.device.kind;
    const { files } = await normalight.estimate(small, {
      quality: "fast",
      refit: false,
      onProgress: ({ stage }) => {
        if (stage === "lights") globalThis.estimating = true;
      },
    });
    const report = files.find(({ name }) => name === "report.json");
    const { device } = JSON.parse(new TextDecoder().decode(report.bytes));
    const after = normalight.device.kind;
    normalight.close();
    return { before, after, heard, used: device };
  });

test("who computes on the processor never fetches the module for the GPU", async () => {
  const kind = await page.evaluate(async () => {
    const normalight = await Normalight.create({ device: "cpu" });
    await normalight.estimate(small, { quality: "fast", refit: false });
    normalight.close();
    return normalight.device.kind;
  });
  assert.equal(kind, "cpu");
  assert.ok(!asked.includes(GPU_MODULE));
});

test("where the module for the GPU is missing, the processor computes", async () => {
  misbehave = (path, response) => path === GPU_MODULE && !!response.writeHead(404).end();
  const { before, after, heard, used } = await estimate();
  assert.deepEqual([before, after], ["gpu", "cpu"]);
  assert.match(used, /^CPU/);
  assert.equal(heard.length, 1);
  assert.match(heard[0] ?? "", /^WebGPU does not start \(.*normalight_gpu_bg\.wasm.*404.*so the processor/);
});

test("where the GPU's process dies in the middle, the processor computes", async () => {
  const running = estimate();
  await page.waitForFunction(() => globalThis.estimating);
  const session = await started.newBrowserCDPSession();
  // It answers only where there is still a process to answer.
  session.send("Browser.crashGpuProcess").catch(() => undefined);
  const { before, after, heard, used } = await running;
  assert.deepEqual([before, after], ["gpu", "cpu"]);
  assert.match(used, /^CPU/);
  assert.match(heard.join(), /^The GPU failed \(.*\), so the processor computes\.$/s);
});
