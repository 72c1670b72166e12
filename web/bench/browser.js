// How long the networks take in Chromium, beside ONNX Runtime: `cargo xtask bench browser`.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { browser } from "../test/support/browser.js";
import { serve } from "../test/support/server.js";

const ROOT = fileURLToPath(new URL("../..", import.meta.url));

/** Photographs and their side in pixels; the large ones are for the processor alone. */
const CASES = [
  { images: 16, side: 192, gpu: true },
  { images: 8, side: 512, gpu: false },
];

const { values: options } = parseArgs({
  options: {
    rounds: { type: "string", default: "5" },
    json: { type: "string" },
    software: { type: "boolean", default: false },
  },
});
const rounds = Number(options.rounds);
assert.ok(Number.isInteger(rounds) && rounds > 0, `--rounds: ${options.rounds}`);

/** @param {number[]} numbers */
function median(numbers) {
  const sorted = numbers.toSorted((a, b) => a - b);
  const [low = NaN, high = NaN] = [sorted[(sorted.length - 1) >> 1], sorted[sorted.length >> 1]];
  return (low + high) / 2;
}

/** Everybody in turns, so that what disturbs one round disturbs all. */
async function measure(page, names, { images, side }) {
  const times = names.map((name) => ({ name, lights: [], normals: [] }));
  // The first round compiles and allocates.
  for (let round = 0; round <= rounds; round++) {
    for (const time of times) {
      const timed = ([name, images, side]) => globalThis.timed(name, images, side);
      const { lights, normals } = await page.evaluate(timed, [time.name, images, side]);
      if (round === 0) continue;
      time.lights.push(lights);
      time.normals.push(normals);
    }
  }
  return times.map(({ name, lights, normals }) => ({
    name,
    lights: { median: median(lights), all: lights },
    normals: { median: median(normals), all: normals },
  }));
}

function print({ images, side, contenders }) {
  console.log(`\n${images} photographs of ${side}x${side}, medians of ${rounds}, seconds`);
  console.log(`${"".padEnd(34)}${"lights".padStart(9)}${"normals".padStart(9)}`);
  for (const { name, lights, normals } of contenders) {
    const [one, other] = [lights, normals].map((times) => times.median.toFixed(3).padStart(9));
    console.log(`${name.padEnd(34)}${one}${other}`);
  }
}

const models = await mkdtemp(join(tmpdir(), "normalight-bench-"));
const server = await serve(ROOT, async (path, response) => {
  // Threads need a page that is isolated from all others.
  response.setHeader("Cross-Origin-Opener-Policy", "same-origin");
  response.setHeader("Cross-Origin-Embedder-Policy", "require-corp");
  if (!/^\/models\/\w+\.onnx$/.test(path)) return false;
  response.end(await readFile(join(models, basename(path))));
  return true;
});
const started = await browser("--enable-unsafe-webgpu");
try {
  const { NORMALIGHT_CLI: program } = process.env;
  assert.ok(program, "NORMALIGHT_CLI names no program");
  for (const network of ["light", "normal"]) {
    execFileSync(program, ["export", "onnx", network, "--out", join(models, `${network}.onnx`)]);
  }
  const page = await started.newPage();
  page.on("pageerror", (error) => console.error(error));
  await page.goto(`${server.url}web/bench/page.html`);
  await page.waitForFunction(() => globalThis.isReady);
  const place = await page.evaluate(() => globalThis.contenders());
  const names = await page.evaluate(() => globalThis.names);
  const withGpu = place.adapter !== null && (!place.software || options.software);
  const { version } = JSON.parse(
    await readFile(join(ROOT, "node_modules/onnxruntime-web/package.json"), "utf8"),
  );
  const adapter = withGpu ? place.adapter : `${place.adapter ?? "no adapter"}, left out`;
  console.log(
    `Chromium ${started.version()}, onnxruntime-web ${version}, ${place.cores} cores, WebGPU: ${adapter}`,
  );
  const cases = [];
  for (const { images, side, gpu } of CASES) {
    const taking = names.filter((name) => {
      if (name.includes("WebGPU")) return gpu && withGpu;
      return !name.includes("2 threads") || (place.isolated && place.cores > 1);
    });
    cases.push({ images, side, contenders: await measure(page, taking, { images, side }) });
    print(cases.at(-1));
  }
  if (options.json !== undefined) {
    const report = { chromium: started.version(), onnxruntime: version, ...place, rounds, cases };
    await writeFile(options.json, `${JSON.stringify(report, null, 2)}\n`);
  }
} finally {
  await started.close();
  server.close();
  await rm(models, { recursive: true, force: true });
}
