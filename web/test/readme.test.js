// The examples of the README do what they show.
import assert from "node:assert/strict";
import { mkdtemp, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { browser } from "./support/browser.js";
import { serve } from "./support/server.js";

const readme = await readFile(new URL("../README.md", import.meta.url), "utf8");
const examples = [...readme.matchAll(/^```js (browser|node)\n(.*?)^```/gms)].map(([, where, code]) => ({
  where,
  code: code ?? "",
}));

/** @type {import("playwright-core").Browser} */
let started;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;
/** @type {string} */
let folder;

before(async () => {
  server = await serve(fileURLToPath(new URL("../..", import.meta.url)));
  started = await browser();
  folder = await mkdtemp(join(tmpdir(), "normalight-readme-"));
});
after(async () => {
  await started?.close();
  server?.close();
  await rm(folder, { recursive: true, force: true });
});

test("there are examples for browsers and for Node.js, and every one is run", () => {
  assert.deepEqual(
    examples.map(({ where }) => where),
    ["browser", "browser", "browser", "node"],
  );
  assert.equal(readme.match(/^```\w/gm)?.length, examples.length);
});

for (const [index, { code }] of examples.filter(({ where }) => where === "browser").entries()) {
  test(`example ${index + 1} for browsers`, async () => {
    const page = await started.newPage();
    /** @type {string[]} */
    const said = [];
    page.on("console", (message) => message.type() === "log" && said.push(message.text()));
    await page.goto(`${server.url}web/test/support/page.html`);
    await page.waitForFunction(() => "samples" in globalThis);
    const text = code.replace('"normalight"', JSON.stringify(`${server.url}web/dist/index.js`));
    await page.evaluate(async (text) => {
      const file = (/** @type {Blob} */ blob) => URL.createObjectURL(blob);
      const drawing = new OffscreenCanvas(64, 64).getContext("2d");
      const pictures = await Promise.all(samples.map((sample) => createImageBitmap(sample)));
      Object.assign(globalThis, { drawing, pictures, input: { files: samples } });
      await import(file(new Blob([text], { type: "text/javascript" })));
    }, text);
    await page.close();
    assert.ok(said.length > 0, "an example shows something");
  });
}

test("the example for Node.js", async () => {
  const example = examples.find(({ where }) => where === "node");
  const sample = fileURLToPath(new URL("../../www/public/samples/statue/", import.meta.url));
  const paths = ["001.png", "005.png", "009.png", "013.png"].map((name) => sample + name);
  const around = `const paths = ${JSON.stringify(paths)};\nconst folder = ${JSON.stringify(folder)};\n`;
  const entry = new URL("../dist/node.js", import.meta.url).href;
  const program = join(folder, "example.mjs");
  await writeFile(program, around + example?.code.replace('"normalight"', JSON.stringify(entry)));
  await import(pathToFileURL(program).href);
  assert.ok((await readdir(folder)).includes("normals.png"));
});
