import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const SOURCES = fileURLToPath(new URL("../../src/", import.meta.url));
const TSC = join(dirname(createRequire(import.meta.url).resolve("typescript/package.json")), "bin", "tsc");

/**
 * Modules of the page that need no browser, compiled for this test alone.
 * @param {string[]} names without extension, from the page's sources
 * @returns {Promise<any[]>}
 */
export async function modules(...names) {
  const folder = mkdtempSync(join(tmpdir(), "normalight-modules-"));
  try {
    writeFileSync(join(folder, "package.json"), '{ "type": "module" }');
    const files = names.map((name) => join(SOURCES, `${name}.ts`));
    const target = ["--target", "ES2023", "--module", "ESNext", "--moduleResolution", "Bundler"];
    const lib = ["--lib", "ES2024,DOM,DOM.Iterable", "--types", "", "--skipLibCheck"];
    const out = ["--rootDir", SOURCES, "--outDir", folder];
    execFileSync(process.execPath, [TSC, "--ignoreConfig", ...files, ...target, ...lib, ...out], {
      stdio: "pipe",
    });
    return await Promise.all(names.map((name) => import(pathToFileURL(join(folder, `${name}.js`)).href)));
  } finally {
    rmSync(folder, { recursive: true });
  }
}
