import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { complaints } from "./support/axe.js";
import { withReport } from "./support/files.js";
import { launch } from "./support/page.js";

/** Wide and narrow, light and dark. */
const LOOKS = /** @type {const} */ ([
  { viewport: { width: 1280, height: 900 }, colorScheme: "light" },
  { viewport: { width: 360, height: 740 }, colorScheme: "dark" },
]);

test("the report of an evaluation is one page for everybody, and its tables sort", async () => {
  const browser = await launch();
  try {
    await withReport(async (folder) => {
      for (const look of LOOKS) {
        const context = await browser.newContext(look);
        const page = await context.newPage();
        /** @type {string[]} */
        const asked = [];
        page.on("request", (request) => asked.push(request.url()));
        page.on("console", (message) => asked.push(message.text()));
        const address = pathToFileURL(join(folder, "index.html")).href;
        await page.goto(address);
        assert.deepEqual(await complaints(page, "html"), []);
        // Pictures are part of the page.
        assert.deepEqual(
          asked.filter((one) => one !== address && !one.startsWith("data:")),
          [],
        );
        const shown = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
        assert.ok((shown[0] ?? 0) <= (shown[1] ?? 0), `${shown} pixels wide`);
        await sorts(page);
        await context.close();
      }
    });
  } finally {
    await browser.close();
  }
});

/** Sorts the first table by its errors, up and down. @param {import("playwright-core").Page} page */
async function sorts(page) {
  const table = page.locator("table").first();
  const heads = await table.locator("thead th").allTextContents();
  const column = heads.indexOf("Normals");
  assert.ok(column > 0, heads.join(", "));
  const read = async () => {
    const cells = await table.locator(`tbody tr > :nth-child(${column + 1})`).allTextContents();
    return cells.map(Number).filter(Number.isFinite);
  };
  const before = await read();
  assert.ok(before.length > 5);
  const head = table.locator("thead button").nth(column);
  const up = before.toSorted((a, b) => a - b);
  /** @type {number[][]} */
  const orders = [];
  for (let click = 0; click < 2; click++) {
    await head.click();
    orders.push(await read());
  }
  assert.deepEqual(new Set(orders.map(String)), new Set([up, up.toReversed()].map(String)));
}
