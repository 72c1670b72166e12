// The packed package in projects of strangers, with their tools' default settings. Not part of `npm test`, because it
// installs those tools from the registry, but a step of `cargo xtask test` (consumers), for it takes about a minute. By hand:
// `npm run test:consumers --workspace web`. Next.js takes 370 MB and several minutes, and was tried by hand.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { cp, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { browser, title } from "../support/browser.js";
import { serve } from "../support/server.js";
import { html, MAIN, Projects } from "./support/project.js";

const run = promisify(execFile);
const GOOD = "ok CPU (flex, WebAssembly), 3 lights, 2 threads";
const PAGE = { "index.html": html("./main.js"), "main.js": MAIN() };
const QUIET = /** @type {const} */ ({ logLevel: "error", server: { port: 0, host: "127.0.0.1" } });

/** @type {Projects} */
let projects;
/** @type {import("playwright-core").Browser} */
let started;

before(async () => {
  projects = await Projects.make();
  started = await browser();
});
after(async () => {
  await started?.close();
  await projects?.remove();
});

/** What the page of a folder says. @param {string} folder */
async function served(folder) {
  const server = await serve(folder);
  try {
    return await title(started, server.url);
  } finally {
    server.close();
  }
}

for (const name of /** @type {const} */ (["vite7", "vite8"])) {
  test(`${name}, development server`, async () => {
    const root = await projects.project(`${name}-dev`, PAGE);
    const { createServer } = await projects.tool(name);
    const server = await (await createServer({ root, ...QUIET })).listen();
    try {
      assert.equal(await title(started, server.resolvedUrls.local[0]), GOOD);
    } finally {
      await server.close();
    }
  });

  test(`${name}, build and preview`, async () => {
    const root = await projects.project(`${name}-build`, PAGE);
    const { build, preview } = await projects.tool(name);
    await build({ root, logLevel: "error" });
    const server = await preview({ root, logLevel: "error", preview: { port: 0, host: "127.0.0.1" } });
    try {
      assert.equal(await title(started, server.resolvedUrls.local[0]), GOOD);
    } finally {
      await server.close();
    }
  });

  test(`${name}, rendering on a server`, async () => {
    const root = await projects.project(`${name}-ssr`, {
      "entry.js": 'export { Normalight } from "normalight";',
    });
    const { createServer } = await projects.tool(name);
    const server = await createServer({
      root,
      ...QUIET,
      appType: "custom",
      server: { middlewareMode: true, ws: false },
    });
    try {
      const { Normalight } = await server.ssrLoadModule("/entry.js");
      assert.equal(typeof Normalight.create, "function");
    } finally {
      await server.close();
    }
  });
}

test("webpack 5", async () => {
  const context = await projects.project("webpack", { "main.js": MAIN() });
  const { default: webpack } = await projects.tool("webpack");
  const path = join(context, "dist");
  const stats = await new Promise((resolve, reject) => {
    const settings = { context, mode: "production", entry: "./main.js", output: { path } };
    webpack(settings, (/** @type {unknown} */ error, /** @type {unknown} */ result) =>
      error ? reject(error) : resolve(result),
    );
  });
  assert.equal(stats.hasErrors(), false, stats.toString());
  await writeFile(join(path, "index.html"), html("./main.js"));
  assert.equal(await served(path), GOOD);
});

test("esbuild, which leaves worker, module and weights to whoever copies them", async () => {
  const main = MAIN().replace('"cpu"', '"cpu", workerUrl: "worker.js", wasmUrl: "wasm/normalight_bg.wasm"');
  const folder = await projects.project("esbuild", { "main.js": main });
  const { build } = await projects.tool("esbuild");
  await build({
    absWorkingDir: folder,
    entryPoints: { main: "main.js", worker: "normalight/browser-worker.js" },
    bundle: true,
    format: "esm",
    splitting: true,
    outdir: "out",
    logLevel: "silent",
  });
  const out = join(folder, "out");
  await cp(join(folder, "node_modules/normalight/wasm"), join(out, "wasm"), { recursive: true });
  await writeFile(join(out, "index.html"), html("./main.js"));
  assert.equal(await served(out), GOOD);
});

test("no bundler, the package's files on the page's server and on another", async () => {
  const there = await projects.project("static", PAGE);
  const packages = await serve(there);
  try {
    for (const from of [
      "./node_modules/normalight/dist/index.js",
      `${packages.url}node_modules/normalight/dist/index.js`,
    ]) {
      const here = await projects.project("static", { ...PAGE, "main.js": MAIN(from) });
      assert.equal(await served(here), GOOD, from);
    }
  } finally {
    packages.close();
  }
});

test("Node.js", async () => {
  const cwd = await projects.project("node", {
    "main.js": MAIN()
      .replaceAll("document.title =", "const title =")
      .replace("} catch", "  console.log(title);\n} catch"),
  });
  const { stdout } = await run(process.execPath, ["main.js"], { cwd });
  assert.equal(stdout.trim(), GOOD);
});
