// What the page costs those who leave it open.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Memory } from "./support/memory.js";
import { quickPage } from "./support/page.js";
import { tiffPages } from "./support/tiff.js";

const page = await quickPage();
const tab = page.page;

test("ten estimates hold no more memory than one", async () => {
  const memory = await Memory.of(tab);
  await tab.evaluate(() => {
    const addresses = new Set();
    const { createObjectURL, revokeObjectURL } = URL;
    URL.createObjectURL = (of) => {
      const address = createObjectURL(of);
      addresses.add(address);
      return address;
    };
    URL.revokeObjectURL = (address) => {
      addresses.delete(address);
      revokeObjectURL(address);
    };
    Object.assign(globalThis, { addresses });
  });
  // Files behind addresses are held outside of the page.
  const addresses = () => tab.evaluate(() => /** @type {any} */ (globalThis).addresses.size);
  await page.upload([
    tiffPages("balls.tif", 96, [
      [0, 0],
      [0.5, 0],
      [-0.5, 0],
      [0, 0.5],
    ]),
  ]);
  await tab.waitForSelector("#stack-kept:visible");
  assert.equal(await page.estimate(), "");
  const [one, few] = [await memory.held(), await addresses()];
  assert.ok(few > 0);
  for (let run = 2; run <= 10; run++) assert.equal(await page.estimate(), "");
  const ten = await memory.held();
  for (const part of /** @type {const} */ (["page", "nodes", "workers", "modules"])) {
    const words = `${part}: ${one[part]} after one estimate, ${ten[part]} after ten`;
    assert.ok(one[part] > 0 && ten[part] <= 1.1 * one[part], words);
  }
  assert.equal(await addresses(), few);
});
