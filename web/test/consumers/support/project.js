import { execFile } from "node:child_process";
import { cp, mkdir, mkdtemp, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { promisify } from "node:util";

const run = promisify(execFile);
const PACKAGE = fileURLToPath(new URL("../../..", import.meta.url));

/** The tools that people bundle with. */
const TOOLS = {
  vite7: "npm:vite@7.3.8",
  vite8: "npm:vite@8.3.8",
  webpack: "5.113.0",
  esbuild: "0.28.2",
};

/** What a consumer's page does; its title says how it went. */
export const MAIN = (from = "normalight") => `
import { Normalight } from ${JSON.stringify(from)};
try {
  const normalight = await Normalight.create({ device: "cpu", threads: 2 });
  const ramp = (across, down) => ({ width: 32, height: 32, channels: 1, data: Uint8Array.from({ length: 1024 }, (_, pixel) => 40 + across * (pixel % 32) + down * (pixel >> 5)) });
  const { lights, threads } = await normalight.estimate([ramp(3, 1), ramp(1, 3), ramp(2, 2)], { mask: "none", quality: "fast" });
  document.title = \`ok \${normalight.device.name}, \${lights.length} lights, \${threads} threads\`;
} catch (error) {
  document.title = \`failed \${error.name}: \${error.message}\`;
}
`;

/** The page around a script. */
export const html = (/** @type {string} */ script) =>
  `<!doctype html><html lang="en"><head><meta charset="utf-8"><link rel="icon" href="data:,"><title>starting</title></head>
<body><script type="module" src="${script}"></script></body></html>`;

/** Projects outside of the workspace that have the packed package, and the tools to build them. */
export class Projects {
  /** @param {string} root */
  constructor(root) {
    this.root = root;
  }

  /** Packs the package and installs it with all tools. */
  static async make() {
    const root = await mkdtemp(join(tmpdir(), "normalight-consumers-"));
    const { stdout } = await run("npm", ["pack", "--json", "--pack-destination", root], { cwd: PACKAGE });
    const [{ filename }] = JSON.parse(stdout);
    const tools = {
      private: true,
      type: "module",
      dependencies: { normalight: `file:./${filename}`, ...TOOLS },
    };
    await writeFile(join(root, "package.json"), JSON.stringify(tools));
    await run("npm", ["install", "--ignore-scripts", "--no-audit", "--no-fund", "--prefer-offline"], {
      cwd: root,
    });
    return new Projects(root);
  }

  /** A new project with these files and the package. @param {string} name @param {Record<string, string>} files */
  async project(name, files) {
    const folder = join(this.root, "projects", name);
    await mkdir(join(folder, "node_modules"), { recursive: true });
    await cp(join(this.root, "node_modules/normalight"), join(folder, "node_modules/normalight"), {
      recursive: true,
    });
    for (const [file, text] of Object.entries({
      "package.json": '{"private":true,"type":"module"}',
      ...files,
    })) {
      await writeFile(join(folder, file), text);
    }
    return folder;
  }

  /** A tool. @param {keyof typeof TOOLS} name */
  async tool(name) {
    const resolved = createRequire(join(this.root, "package.json")).resolve(name);
    // Vite's own requires are for older programs.
    const file = name.startsWith("vite")
      ? join(this.root, "node_modules", name, "dist/node/index.js")
      : resolved;
    return await import(pathToFileURL(file).href);
  }

  /** Removes all of it. */
  async remove() {
    await rm(this.root, { recursive: true, force: true });
  }
}
