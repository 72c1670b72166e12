import { fileURLToPath } from "node:url";
import { runnerImport } from "vite";

/**
 * A module of the page that touches no document, for tests without a browser.
 * @param {string} path below `src`
 * @returns {Promise<any>} what it exports
 */
export async function source(path) {
  const root = fileURLToPath(new URL("../..", import.meta.url));
  const { module } = await runnerImport(`/src/${path}`, { root, configFile: false, logLevel: "silent" });
  return module;
}
