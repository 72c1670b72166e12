// What strangers get: the files, their types, and what package.json says.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { checkPackage, createPackageFromTarballData } from "@arethetypeswrong/core";

const ROOT = fileURLToPath(new URL("..", import.meta.url));

/** @type {string} */
let folder;
/** @type {{ filename: string, files: { path: string, mode: number }[] }} */
let packed;

before(() => {
  folder = mkdtempSync(join(tmpdir(), "normalight-package-"));
  const text = execFileSync("npm", ["pack", "--json", "--pack-destination", folder], {
    cwd: ROOT,
    encoding: "utf8",
    stdio: ["ignore", "pipe", "ignore"],
  });
  // A list, or from npm 12 on an object by name.
  packed = /** @type {typeof packed} */ (Object.values(JSON.parse(text))[0]);
});
after(() => rmSync(folder, { recursive: true, force: true }));

test("the package holds what it needs and nothing else", () => {
  const paths = packed.files.map(({ path }) => path);
  for (const path of paths) {
    assert.match(
      path,
      /^(dist\/[\w-]+\.(js|jsx|d\.ts)|wasm\/[\w.]+|README\.md|LICENSE-(MIT|APACHE)|package\.json)$/,
    );
  }
  for (const needed of [
    "README.md",
    "LICENSE-MIT",
    "LICENSE-APACHE",
    "wasm/normalight.js",
    "wasm/normalight.d.ts",
    "wasm/normalight_bg.wasm",
    "wasm/normalight_gpu.js",
    "wasm/normalight_gpu_bg.wasm",
    "wasm/light.safetensors",
    "wasm/normal.safetensors",
    "dist/bin.js",
    "dist/browser-worker.js",
    "dist/node-worker.js",
  ]) {
    assert.ok(paths.includes(needed), needed);
  }
});

test("what package.json names is there, and it names no host", () => {
  const text = readFileSync(join(ROOT, "package.json"), "utf8");
  const paths = packed.files.map(({ path }) => path);
  const named = text.match(/"\.\/[\w/.-]+\.\w+"/g) ?? [];
  // Keys of `exports` are no files.
  const files = named
    .map((name) => name.slice(3, -1))
    .filter((name) => name.includes("/") || name === "package.json");
  assert.ok(files.length >= 6);
  for (const file of files) assert.ok(paths.includes(file), file);
  const about = JSON.parse(text);
  for (const absent of ["private", "repository", "homepage", "bugs", "dependencies"]) {
    assert.ok(!(absent in about), absent);
  }
  assert.equal(about.license, "MIT OR Apache-2.0");
  assert.equal(about.engines.node, ">=20.19");
});

test("types are found by every way of resolving that can load modules", async () => {
  const tarball = new Uint8Array(readFileSync(join(folder, packed.filename)));
  const result = await checkPackage(createPackageFromTarballData(tarball), {
    // They are no modules with types.
    excludeEntrypoints: [/\.(wasm|safetensors|json)$/, "./browser-worker.js"],
  });
  assert.ok(result.types, "the package has types");
  // As a package of modules alone, it has nothing for who calls `require`, or knows no `exports`.
  const problems = result.problems.filter(
    (problem) => !("resolutionKind" in problem && ["node10", "node16-cjs"].includes(problem.resolutionKind)),
  );
  assert.deepEqual(problems, []);
});
