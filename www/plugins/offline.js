import { createHash } from "node:crypto";
import { readdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";

const WORKER = "service-worker.js";

/**
 * Builds the service worker, under a name that stays, and gives it the list of all files with their hashes.
 *
 * Ours in place of workbox, which brings three hundred packages for what is a hundred lines here.
 * @returns {import("vite").Plugin}
 */
export function offline() {
  let folder = "";
  return {
    name: "offline",
    apply: "build",
    config: () => ({
      build: {
        rolldownOptions: {
          input: { index: "index.html", worker: "service-worker/worker.ts" },
          output: {
            entryFileNames: ({ name }) => (name === "worker" ? WORKER : "assets/[name]-[hash].js"),
          },
        },
      },
    }),
    configResolved({ root, build }) {
      folder = join(root, build.outDir);
    },
    // All files are there now, those of `public` too.
    closeBundle: {
      order: "post",
      sequential: true,
      async handler() {
        const path = join(folder, WORKER);
        const code = await readFile(path, "utf8");
        const parts = code.split("__FILES__");
        if (parts.length !== 2)
          this.error(`${WORKER} names the list of files ${parts.length - 1} times, not once`);
        await writeFile(path, parts.join(JSON.stringify(await hashes(folder))));
      },
    },
  };
}

/** @param {string} folder @returns {Promise<Record<string, string>>} integrity metadata by path */
async function hashes(folder) {
  const entries = await readdir(folder, { recursive: true, withFileTypes: true });
  const paths = entries
    .filter((entry) => entry.isFile() && entry.name !== WORKER)
    .map(({ parentPath, name }) => join(parentPath, name))
    .sort();
  const list = paths.map(async (path) => {
    const hash = createHash("sha256")
      .update(await readFile(path))
      .digest("base64");
    return [path.slice(folder.length + 1).replaceAll("\\", "/"), `sha256-${hash}`];
  });
  return Object.fromEntries(await Promise.all(list));
}
