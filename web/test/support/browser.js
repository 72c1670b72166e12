import assert from "node:assert/strict";
import { chromium } from "playwright-core";

/** Milliseconds for a page to say how it went. */
const PATIENCE = 150_000;

/** Starts the browser of the tests. @param {...string} switches further ones */
export async function browser(...switches) {
  const { NORMALIGHT_CHROMIUM: executablePath } = process.env;
  assert.ok(executablePath, "NORMALIGHT_CHROMIUM names no browser");
  return await chromium.launch({
    executablePath,
    args: ["--no-sandbox", "--disable-quic", "--no-first-run", ...switches],
  });
}

/**
 * The title of a page as soon as it begins with `ok` or `failed`.
 *
 * @param {import("playwright-core").Browser} started
 * @param {string} address
 */
export async function title(started, address) {
  const page = await started.newPage();
  /** @type {string[]} */
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("response", (response) => {
    if (response.status() >= 400) complaints.push(`${response.status()} ${response.url()}`);
  });
  try {
    await page.goto(address);
    await page.waitForFunction(() => /^(ok|failed) /.test(document.title), null, { timeout: PATIENCE });
    return await page.title();
  } catch (error) {
    return [String(error), ...complaints].join("\n");
  } finally {
    await page.close();
  }
}
