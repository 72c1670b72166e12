// The package in a browser: what may be handed over, cancelling, closing, several at once.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { browser } from "./support/browser.js";
import { serve } from "./support/server.js";

/** @type {import("playwright-core").Browser} */
let started;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;
/** @type {import("playwright-core").Page} */
let page;

before(async () => {
  server = await serve(fileURLToPath(new URL("../..", import.meta.url)));
  started = await browser();
  page = await started.newPage();
  await page.goto(`${server.url}web/test/support/page.html`);
  await page.waitForFunction(() => "samples" in globalThis);
});
after(async () => {
  await started?.close();
  server?.close();
});

/** Runs in the page, which has `Normalight`, `samples` (files) and `small` (raw images of 48x48 pixels). */
const inPage = (/** @type {() => unknown} */ work) => page.evaluate(work);

test("the same photograph looks the same in every form", async () => {
  const seen = await inPage(async () => {
    const normalight = await Normalight.create({ device: "cpu" });
    const [file] = samples;
    const bitmap = await createImageBitmap(file);
    const { width, height } = bitmap;
    const canvas = document.createElement("canvas");
    Object.assign(canvas, { width, height });
    const drawing = canvas.getContext("2d");
    drawing.drawImage(bitmap, 0, 0);
    const image = new Image();
    image.src = URL.createObjectURL(file);
    const data = drawing.getImageData(0, 0, width, height);
    const bytes = await file.arrayBuffer();
    const wide = Uint16Array.from(data.data, (sample) => sample * 257);
    const offscreen = new OffscreenCanvas(width, height);
    offscreen.getContext("2d").drawImage(bitmap, 0, 0);
    const forms = {
      file,
      blob: new Blob([bytes]),
      bytes,
      view: new Uint8Array(bytes),
      named: { name: "a.png", bytes: new Uint8Array(bytes) },
      bitmap,
      canvas,
      offscreen,
      image,
      data,
      wide: { data: wide, width, height, colorSpace: "srgb" },
      frame: new VideoFrame(bitmap, { timestamp: 0 }),
    };
    const thumbnails = {};
    for (const [form, source] of Object.entries(forms)) {
      const { rgba } = await normalight.thumbnail(source, { side: 16 });
      thumbnails[form] = Array.from(rgba);
    }
    normalight.close();
    return thumbnails;
  });
  const { file, ...others } = /** @type {Record<string, number[]>} */ (seen);
  assert.ok(file && file.length === 16 * 16 * 4);
  for (const [form, thumbnail] of Object.entries(others)) {
    const apart = Math.max(...thumbnail.map((value, index) => Math.abs(value - (file[index] ?? 0))));
    // A frame may keep its colours as luma and chroma.
    assert.ok(apart <= (form === "frame" ? 6 : 1), `${form}: ${apart}`);
  }
});

test("samples go all the way, in a worker and without one", async () => {
  for (const worker of [true, false]) {
    const [names, shape, taken, fractions] = await page.evaluate(async (worker) => {
      const fractions = [];
      const onProgress = ({ fraction }) => fractions.push(fraction);
      const normalight = await Normalight.create({ device: "cpu", worker, onProgress });
      const result = await normalight.estimate(small, { quality: "fast" });
      normalight.close();
      return [
        result.lights.map(({ file }) => file),
        result.normalMap.shape,
        result.plan.color.taken,
        fractions,
      ];
    }, worker);
    assert.deepEqual(
      names,
      [1, 2, 3, 4, 5, 6].map((number) => `image_00${number}.png`),
    );
    assert.deepEqual(shape, [48, 48, 3]);
    assert.match(taken, /sRGB|files/i);
    assert.equal(fractions.at(-1), 1);
  }
});

test("floats and 16 bits are taken as linear", async () => {
  const taken = await inPage(async () => {
    const normalight = await Normalight.create({ device: "cpu" });
    const colors = [];
    for (const type of [Float32Array, Uint16Array]) {
      const scale = type === Float32Array ? 1 / 255 : 257;
      const rgb = (data) =>
        type.from(
          data.filter((_, index) => index % 4 < 3),
          (sample) => sample * scale,
        );
      const images = small.map(({ data, width, height }) => ({ data: rgb(Array.from(data)), width, height }));
      const plan = await new Promise((resolve, reject) => {
        const stop = new AbortController();
        const onPlan = (plan) => {
          resolve(plan);
          stop.abort();
        };
        normalight.estimate(images, { quality: "fast", onPlan, signal: stop.signal }).catch(reject);
      });
      colors.push(plan.color);
    }
    normalight.close();
    return colors;
  });
  assert.match(JSON.stringify(taken), /linear.*stated.*linear.*stated/s);
});

test("a call may be cancelled before, while and after it runs", async () => {
  const heard = await inPage(async () => {
    const normalight = await Normalight.create({ device: "cpu" });
    const wordsOf = (promise) =>
      promise.then(
        () => "done",
        (error) => error.message,
      );
    const before = await wordsOf(
      normalight.estimate(small, { signal: AbortSignal.abort(new Error("before")) }),
    );
    const stop = new AbortController();
    const onProgress = ({ stage }) => stage === "lights" && stop.abort(new Error("while"));
    const during = await wordsOf(normalight.estimate(small, { signal: stop.signal, onProgress }));
    const late = new AbortController();
    const ended = await wordsOf(normalight.thumbnail(small[0], { signal: late.signal }));
    late.abort();
    const next = await wordsOf(normalight.thumbnail(small[0]));
    const loading = new AbortController();
    const created = Normalight.create({
      signal: loading.signal,
      onProgress: () => loading.abort(new Error("loading")),
    });
    const never = await wordsOf(created);
    normalight.close();
    return [before, during, ended, next, never];
  });
  assert.deepEqual(heard, ["before", "while", "done", "done", "loading"]);
});

test("two at once do not disturb each other; a closed one refuses in words", async () => {
  const [names, closed] = await inPage(async () => {
    const [first, second] = await Promise.all([
      Normalight.create({ device: "cpu" }),
      Normalight.create({ device: "cpu" }),
    ]);
    const under = first.estimate(small, { quality: "fast" }).catch((error) => error.code);
    const other = second.estimate(small, { quality: "fast" });
    first.close();
    first.close();
    const refused = await first.plan([]).catch((error) => `${error.name}: ${error.message}`);
    const { files } = await other;
    second.close();
    return [files.map(({ name }) => name), [await under, refused]];
  });
  assert.ok(names.includes("normals.png"));
  assert.deepEqual(closed, ["closed", "NormalightError: this estimator was closed"]);
  // The browser tells of their end a little later.
  for (let waited = 0; page.workers().length > 0 && waited < 2000; waited += 20)
    await page.waitForTimeout(20);
  assert.equal(page.workers().length, 0);
});
