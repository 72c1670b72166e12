// Networks as ONNX models: another runtime gets from them what ours computes.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync } from "node:fs";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { env, InferenceSession, Tensor } from "onnxruntime-web";
import { BODIES, CELLS } from "./support/bodies.js";
import { readNpy } from "./support/npy.js";

const SHIPPED = fileURLToPath(new URL("../../models/default", import.meta.url));

/** Largest difference, as a share of the largest number. */
const CLOSE = 1e-4;

const OUTPUTS = { light: ["directions", "intensities", "scores"], normal: ["normals"] };

// More would run in workers, and wait for them.
env.wasm.numThreads = 1;

/** @typedef {{ shape: number[], data: Float32Array }} Numbers */

/** @type {string} */
let folder;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "normalight-onnx-"));
});
after(() => rm(folder, { recursive: true, force: true }));

/** Runs the command; what it says where it fails. @param {...string} args */
function normalight(...args) {
  const { NORMALIGHT_CLI: program } = process.env;
  assert.ok(program, "NORMALIGHT_CLI names no program");
  const { status, stderr } = spawnSync(program, args, { cwd: folder, encoding: "utf8", timeout: 60_000 });
  return status === 0 ? undefined : stderr;
}

/** A network exported with its example. @param {"light" | "normal"} network @param {...string} more */
async function exported(network, ...more) {
  const example = join(folder, "example");
  const args = ["export", "onnx", network, "--out", "model.onnx", "--example", example, ...more];
  assert.equal(normalight(...args), undefined);
  const session = await InferenceSession.create(new Uint8Array(await readFile(join(folder, "model.onnx"))));
  /** @type {Record<string, Numbers>} */
  const expected = {};
  for (const name of OUTPUTS[network]) expected[name] = await readNpy(join(example, `${name}.npy`));
  return { session, expected, images: await readNpy(join(example, "images.npy")) };
}

/** @param {InferenceSession} session @param {Numbers} images */
async function outputs(session, { data, shape }) {
  return await session.run({ images: new Tensor("float32", data, shape) });
}

/** @param {import("onnxruntime-web").OnnxValue | undefined} found @param {Numbers} expected @param {string} what */
function assertClose(found, expected, what) {
  assert.ok(found instanceof Tensor && found.data instanceof Float32Array, what);
  const { data } = found;
  assert.deepEqual([...found.dims], expected.shape, what);
  assert.equal(data.length, expected.data.length, what);
  const scale = expected.data.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  assert.ok(scale > 0.1, `${what}: nothing above ${scale}`);
  const apart = expected.data.reduce(
    (most, value, at) => Math.max(most, Math.abs(value - (data[at] ?? NaN))),
    0,
  );
  assert.ok(apart <= CLOSE * scale, `${what}: ${apart} apart, of ${scale}`);
}

/** The same once more behind itself. @param {Float32Array} data */
function doubled(data) {
  const both = new Float32Array(2 * data.length);
  both.set(data);
  both.set(data, data.length);
  return both;
}

for (const network of /** @type {const} */ (["light", "normal"])) {
  test(`the shipped ${network} network gives the same, for any number of photographs`, async () => {
    const { session, expected, images } = await exported(network);
    assert.deepEqual(session.outputNames, OUTPUTS[network]);
    const found = await outputs(session, images);
    for (const [name, values] of Object.entries(expected)) assertClose(found[name], values, name);
    // A photograph that is there twice changes nothing for the others.
    const [count = 0, ...sides] = images.shape;
    const twice = await outputs(session, { data: doubled(images.data), shape: [2 * count, ...sides] });
    for (const [name, { data, shape }] of Object.entries(expected)) {
      const both = name === "normals" ? data : doubled(data);
      const [rows = 0, ...rest] = shape;
      assertClose(twice[name], { data: both, shape: [name === "normals" ? rows : 2 * rows, ...rest] }, name);
    }
  });
}

test("so do networks of every other architecture", async () => {
  await writeFile(join(folder, "cells.json"), JSON.stringify(CELLS));
  for (const [name, { network, recipe }] of Object.entries(BODIES)) {
    await writeFile(join(folder, `${name}.toml`), recipe);
    const run = join(folder, name);
    const args = ["train", network, "--recipe", `${name}.toml`, "--run", run, "--device", "cpu", "--quiet"];
    assert.equal(normalight(...args), undefined, name);
    const { session, expected, images } = await exported(
      network,
      "--weights",
      join(run, "weights.safetensors"),
    );
    const found = await outputs(session, images);
    for (const [output, values] of Object.entries(expected)) {
      assertClose(found[output], values, `${name}: ${output}`);
    }
  }
});

test("what the model says of itself is in it", async () => {
  await exported("normal");
  const text = (await readFile(join(folder, "model.onnx"))).toString("latin1");
  const weights = await readFile(join(SHIPPED, "normal.safetensors"));
  assert.ok(text.includes(createHash("sha256").update(weights).digest("hex")));
  assert.ok(text.includes("root mean square"));
});

test("another network is refused, and nothing is left", () => {
  const weights = join(SHIPPED, "normal.safetensors");
  const said = normalight("export", "onnx", "light", "--weights", weights, "--out", "deep/light.onnx");
  assert.match(said ?? "", /^error: .*holds a normal network, a light network is expected\n$/);
  assert.ok(!existsSync(join(folder, "deep")));
});
