// What ends, is missing or is damaged: words at once, and a fresh start works.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, beforeEach, test } from "node:test";
import { fileURLToPath } from "node:url";
import { browser } from "./support/browser.js";
import { serve } from "./support/server.js";

const ROOT = fileURLToPath(new URL("../..", import.meta.url));
/** Milliseconds until words come: a second, and more for computers that have much else to do. */
const SOON = 5000;
const MODULE = "/web/wasm/normalight_bg.wasm";

/** @type {import("playwright-core").Browser} */
let started;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;
/** @type {import("playwright-core").Page} */
let page;
/** @type {import("./support/server.js").Misbehaviour} */
let misbehave = () => false;

before(async () => {
  server = await serve(ROOT, (path, response) => misbehave(path, response));
  started = await browser();
  page = await started.newPage();
  await page.goto(`${server.url}web/test/support/page.html`);
  await page.waitForFunction(() => "samples" in globalThis);
});
beforeEach(() => {
  misbehave = () => false;
});
after(async () => {
  await started?.close();
  server?.close();
});

/** What `create` says, and milliseconds until then. @param {object} [options] */
const create = (options = {}) =>
  page.evaluate(async (options) => {
    const begun = performance.now();
    const words = await Normalight.create({ device: "cpu", ...options }).then(
      (normalight) => {
        normalight.close();
        return "ok";
      },
      ({ name, code, kind, message }) => `${name} ${code} ${kind} ${message}`,
    );
    return { words, time: performance.now() - begun };
  }, options);

/** The module as a server should not deliver it. */
const BAD_MODULES = {
  "is missing": [404, () => new Uint8Array(), {}, /the server answers 404/],
  "fails on the server": [500, () => new Uint8Array(), {}, /the server answers 500/],
  "is a page that says it is missing": [
    200,
    () => new TextEncoder().encode("<!doctype html><title>Not found</title>"),
    { "Content-Type": "text/html" },
    /no module or a damaged one/,
  ],
  "is cut off": [200, (bytes) => bytes.subarray(0, 100_000), {}, /no module or a damaged one/],
  "ends before its length": [
    200,
    (bytes) => bytes.subarray(0, 100_000),
    { "Content-Length": "200000" },
    /cannot be fetched or ended too early/,
  ],
  "is damaged in the middle": [
    200,
    (bytes) => Buffer.from(bytes).fill(0xff, 1_000_000, 1_000_100),
    {},
    /no module or a damaged one/,
  ],
  "is another module": [
    200,
    () => new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]),
    {},
    /of another version/,
  ],
};

for (const [what, [status, make, headers, words]] of Object.entries(BAD_MODULES)) {
  test(`a module that ${what}`, async () => {
    const bytes = make(await readFile(ROOT + MODULE));
    misbehave = (path, response) => {
      if (path !== MODULE) return false;
      response.writeHead(status, { "Content-Type": "application/wasm", ...headers });
      response.write(bytes);
      if (headers["Content-Length"]) setTimeout(() => response.destroy(), 50);
      else response.end();
      return true;
    };
    const failed = await create();
    assert.match(failed.words, /^NormalightError load device http.*normalight_bg\.wasm cannot be loaded: /);
    assert.match(failed.words, words);
    // Only compiling finds damage in the middle, and it is compiled twice: as long as a computer takes for that.
    const limit = what === "is damaged in the middle" ? 20 * SOON : SOON;
    assert.ok(failed.time < limit, `${failed.time} ms`);
    misbehave = () => false;
    assert.equal((await create()).words, "ok");
  });
}

test("a module of which a cache holds half is fetched past it", async () => {
  const bytes = await readFile(ROOT + MODULE);
  let asked = 0;
  misbehave = (path, response) => {
    if (path !== MODULE || asked++ > 0) return false;
    response.writeHead(200, { "Cache-Control": "max-age=600" }).end(bytes.subarray(0, 100_000));
    return true;
  };
  assert.equal((await create()).words, "ok");
  assert.equal(asked, 2);
});

test("a worker that is missing", async () => {
  const failed = await create({ workerUrl: "nowhere.js" });
  assert.match(failed.words, /^NormalightError load device The worker does not start.*workerUrl/);
  assert.ok(failed.time < SOON, `${failed.time} ms`);
  misbehave = (path, response) => path.endsWith("/yielding.js") && !!response.writeHead(500).end();
  assert.match((await create()).words, /^NormalightError load device The worker does not start/);
  misbehave = () => false;
  assert.equal((await create()).words, "ok");
});

for (const [what, end] of /** @type {const} */ ([
  ["closes itself", "globalThis.close()"],
  ["throws outside of any task", "setTimeout(() => { throw new Error('broken') })"],
])) {
  test(`a worker that ${what} while it has a task`, async () => {
    const running = page.evaluate(async () => {
      const normalight = await Normalight.create({ device: "cpu" });
      let ended = 0;
      globalThis.aboutToEnd = () => {
        ended = performance.now();
      };
      let begun;
      const going = new Promise((resolve) => {
        begun = resolve;
      });
      const failing = normalight.estimate(small, { onProgress: begun });
      failing.catch(() => undefined);
      await going;
      globalThis.going = true;
      const words = await failing.catch(({ code, message }) => `${code} ${message}`);
      const time = performance.now() - ended;
      const { rgba } = await normalight.thumbnail(small[0]);
      normalight.close();
      return { words, time, next: rgba.length > 0 };
    });
    await page.waitForFunction(() => globalThis.going);
    await page.evaluate(() => {
      globalThis.going = false;
      globalThis.aboutToEnd();
    });
    await page.workers()[0]?.evaluate(end);
    const { words, time, next } = await running;
    assert.match(words, /^crashed Something broke in the computation: /);
    assert.ok(time < SOON, `${time} ms`);
    assert.ok(next, "the next call starts a new worker");
  });
}

test("an idle worker that ends is replaced at the next call", async () => {
  await page.evaluate(async () => {
    globalThis.idle = await Normalight.create({ device: "cpu" });
  });
  await page.workers()[0]?.evaluate("globalThis.close()");
  await page.waitForTimeout(50);
  const length = await page.evaluate(async () => {
    const { rgba } = await globalThis.idle.thumbnail(small[0], { side: 8 });
    globalThis.idle.close();
    return rgba.length;
  });
  assert.equal(length, 8 * 8 * 4);
});
