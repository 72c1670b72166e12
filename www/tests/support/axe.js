import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

/**
 * What axe finds wrong in a part of the page, in words.
 * @param {import("playwright-core").Page} tab @param {string} part a selector
 * @returns {Promise<string[]>}
 */
export async function complaints(tab, part) {
  // Not as an element of the page, whose policy allows its own scripts only.
  await tab.evaluate(`${await readFile(AXE, "utf8")};0`);
  return await tab.evaluate(async (selector) => {
    // @ts-expect-error: axe comes as a script.
    const { violations } = await axe.run(selector);
    return violations.map(
      (/** @type {{ id: string, help: string, nodes: { target: string[] }[] }} */ { id, help, nodes }) =>
        `${id}: ${help}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`,
    );
  }, part);
}
