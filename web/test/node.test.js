// The package in Node.js: as a module, and as a command.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtemp, readdir, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { Normalight, NormalightError } from "normalight";

const SAMPLE = fileURLToPath(new URL("../../www/public/samples/statue", import.meta.url));
const BIN = fileURLToPath(new URL("../dist/bin.js", import.meta.url));

/** @type {import("normalight").NamedFile[]} */
let files;
/** @type {string} */
let folder;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "normalight-node-"));
  const names = ["001.png", "004.png", "007.png", "010.png", "mask.png"];
  files = await Promise.all(
    names.map(async (name) => ({ name, bytes: new Uint8Array(await readFile(join(SAMPLE, name))) })),
  );
});
after(() => rm(folder, { recursive: true, force: true }));

/** An archive of files. @param {typeof files} contents */
function tar(contents) {
  const blocks = contents.flatMap(({ name, bytes }) => {
    const head = Buffer.alloc(512);
    head.write(name, 0);
    head.write("0000644\0", 100);
    head.write(`${bytes.length.toString(8).padStart(11, "0")} `, 124);
    head.write("        0ustar\x0000", 148);
    const sum = head.reduce((total, byte) => total + byte, 0);
    head.write(`${sum.toString(8).padStart(6, "0")}\0 `, 148);
    return [head, bytes, Buffer.alloc((512 - (bytes.length % 512)) % 512)];
  });
  return new Uint8Array(Buffer.concat([...blocks, Buffer.alloc(1024)]));
}

test("one thread, several and the calling thread give the same", async () => {
  const results = [];
  for (const options of [{ threads: 1 }, { threads: 3 }, { worker: false }]) {
    const normalight = await Normalight.create(options);
    assert.equal(normalight.device.kind, "cpu");
    const heard = new Set();
    results.push(
      await normalight.estimate(files, {
        quality: "fast",
        refit: false,
        onProgress: ({ stage }) => heard.add(stage),
      }),
    );
    assert.ok(heard.has("lights") && heard.has("normals"));
    normalight.close();
    normalight.close();
    await assert.rejects(normalight.plan([]), { code: "closed", message: "this estimator was closed" });
  }
  const [first, second, third] = results;
  assert.deepEqual(
    results.map(({ threads }) => threads),
    [1, 3, 1],
  );
  assert.equal(first?.lights.length, 4);
  assert.deepEqual(first?.normalMap, second?.normalMap);
  assert.deepEqual(first?.normalMap, third?.normalMap);
});

test("what cannot be is refused in words, and files of Node's own do", async () => {
  await assert.rejects(Normalight.create({ threads: 0 }), { code: "input", message: /^threads: found 0/ });
  const normalight = await Normalight.create();
  await assert.rejects(normalight.estimate(files.slice(0, 2)), (error) => {
    assert.ok(error instanceof NormalightError);
    return error.code === "input";
  });
  const loose = files.map(({ name, bytes }) => new File([bytes], name));
  const { images } = await normalight.plan(loose);
  assert.equal(images.length, 4);
  assert.equal(await normalight.unpack(loose), undefined);
  const stop = new AbortController();
  const running = normalight.estimate(files, { signal: stop.signal, onProgress: () => stop.abort() });
  await assert.rejects(running, { name: "AbortError" });
  normalight.close();
});

test("files come out of archives with their names", async () => {
  const normalight = await Normalight.create();
  const unpacked = await normalight.unpack([{ name: "capture.tar", bytes: tar(files) }]);
  normalight.close();
  assert.deepEqual(unpacked?.archives, ["capture.tar"]);
  assert.deepEqual(
    unpacked?.files.map(({ name, size }) => [name.split("/").at(-1), size]),
    files.map(({ name, bytes }) => [name, bytes.length]),
  );
});

test("a module that is not there fails in words", async () => {
  await assert.rejects(Normalight.create({ wasmUrl: "nowhere.wasm" }), {
    code: "load",
    message: /^file:.*nowhere\.wasm cannot be loaded: ENOENT/,
  });
});

test("who never closes it still ends", () => {
  const program =
    'const { Normalight } = await import("normalight"); await Normalight.create(); console.log("made")';
  const cwd = fileURLToPath(new URL(".", import.meta.url));
  const { status, stdout } = spawnSync(process.execPath, ["--input-type=module", "--eval", program], {
    cwd,
    encoding: "utf8",
    timeout: 60_000,
  });
  assert.deepEqual([status, stdout], [0, "made\n"]);
});

/** Runs the command. @param {string[]} args */
const run = (...args) => spawnSync(process.execPath, [BIN, ...args], { encoding: "utf8", timeout: 120_000 });

test("the command writes whole files and says what was taken for what", async () => {
  const out = join(folder, "deep/result");
  const { status, stdout, stderr } = run(
    "estimate",
    SAMPLE,
    "--out",
    out,
    "--images",
    "4",
    "--quality",
    "fast",
  );
  assert.equal(status, 0, stderr);
  assert.match(stdout, /^photographs: 4 .*mask: mask\.png/s);
  const names = await readdir(out);
  assert.deepEqual(names.sort(), [
    "albedo.png",
    "lights.csv",
    "lights.lp",
    "lights.svg",
    "mask.png",
    "normals.npy",
    "normals.png",
    "report.json",
  ]);
  const report = JSON.parse(await readFile(join(out, "report.json"), "utf8"));
  assert.equal(report.inputs.length, 4);
});

test("the command refuses in words, and leaves nothing", async () => {
  const out = join(folder, "nothing");
  for (const [args, code, words] of /** @type {const} */ ([
    [["estimate", join(folder, "nowhere"), "--out", out], 1, /^error: ENOENT.*nowhere/],
    [["estimate", BIN, "--out", out], 1, /^error: bin\.js: found .* expected an image/],
    [
      ["estimate", SAMPLE, "--out", out, "--quality", "good"],
      1,
      /--quality good: must be one of fast, default, best/,
    ],
    [["estimate", SAMPLE], 2, /--out is missing/],
    [["train"], 2, /there is no command train/],
    [["estimate", SAMPLE, "--what"], 2, /--what/],
  ])) {
    const { status, stderr } = run(...args);
    assert.match(stderr, words);
    assert.equal(status, code, args.join(" "));
    assert.ok(!stderr.includes("    at "), stderr);
  }
  assert.ok(!(await readdir(folder)).includes("nothing"));
  assert.match(run("--version").stdout, /^normalight \d+\.\d+\.\d+\n$/);
  assert.match(run("--help").stdout, /estimate PHOTOS/);
});
