import { createRequire } from "node:module";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

/**
 * What axe finds wrong in a part of the page, in words.
 * @param {import("playwright-core").Page} tab @param {string} part a selector
 * @returns {Promise<string[]>}
 */
export async function complaints(tab, part) {
  await tab.addScriptTag({ path: AXE });
  return await tab.evaluate(async (selector) => {
    // @ts-expect-error: axe comes as a script.
    const { violations } = await axe.run(selector);
    return violations.map(
      (/** @type {{ id: string, help: string, nodes: { target: string[] }[] }} */ { id, help, nodes }) =>
        `${id}: ${help}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`,
    );
  }, part);
}
