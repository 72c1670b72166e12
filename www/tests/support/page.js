import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after } from "node:test";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { preview } from "vite";

/** Milliseconds for the longest step, and for a run on a GPU that two processor cores imitate. */
const PATIENCE = 120_000;
const PATIENCE_GPU = 480_000;

/** A browser that does nothing by itself. */
export const QUIET = [
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** Starts the browser of the tests, quiet but for these arguments. @param {string[]} args */
export async function launch(...args) {
  const { NORMALIGHT_CHROMIUM: executablePath } = process.env;
  assert.ok(executablePath, "NORMALIGHT_CHROMIUM names no browser");
  return await chromium.launch({ executablePath, args: [...QUIET, ...args] });
}

/** Serves the built page. */
export async function serveBuild() {
  const server = await preview({
    root: fileURLToPath(new URL("../..", import.meta.url)),
    logLevel: "silent",
    preview: { host: "127.0.0.1", port: 0, strictPort: false },
  });
  return { address: server.resolvedUrls?.local[0] ?? "", close: () => server.close() };
}

/** The page for the tests of a file, set to estimate as quick as can be on the processor; closed after them. */
export async function quickPage() {
  const page = await Page.open({ webgpu: false });
  after(() => page.close());
  await page.quick();
  return page;
}

/** The page in a browser of its own; whatever reaches the browser's console fails the test. */
export class Page {
  /** @type {string[]} */
  #complaints = [];

  /**
   * @param {import("playwright-core").Page} page
   * @param {() => Promise<void>} close
   * @param {number} [patience]
   */
  constructor(page, close, patience = PATIENCE) {
    this.page = page;
    this.close = close;
    page.setDefaultTimeout(patience);
    page.on("console", (message) => {
      // Without a GPU the browser says that showing what WebGL drew takes time.
      if (/GL Driver Message \(OpenGL, Performance/.test(message.text())) return;
      if (message.text() === "Service Worker registration blocked by Playwright") return;
      if (["error", "warning"].includes(message.type())) this.#complaints.push(message.text());
    });
    page.on("pageerror", (error) => this.#complaints.push(String(error)));
    page.on("requestfailed", (request) => {
      const why = request.failure()?.errorText;
      // What a page was still fetching when it was left or loaded anew.
      if (why === "net::ERR_ABORTED") return;
      this.#complaints.push(`${request.url()} failed: ${why}`);
    });
  }

  /**
   * Opens the built page: from a server of its own, or at an address.
   * @param {{ webgpu: boolean, offline?: boolean, address?: string, args?: string[], locale?: string }} options
   * `offline`: with its service worker, which answers before a test's routes do
   */
  static async open({ webgpu, offline = false, address, args = [], locale = "en-US" }) {
    const server = address === undefined ? await serveBuild() : undefined;
    const devices = webgpu ? ["--enable-unsafe-webgpu"] : [];
    const browser = await launch(...devices, ...args);
    const context = await browser.newContext({
      viewport: { width: 1280, height: 900 },
      serviceWorkers: offline ? "allow" : "block",
      locale,
    });
    const page = await context.newPage();
    const close = async () => {
      await browser.close();
      await server?.close();
    };
    const opened = new Page(page, close, webgpu ? PATIENCE_GPU : undefined);
    await page.goto(address ?? server?.address ?? "");
    await opened.ready();
    return opened;
  }

  /** Waits until the estimator is loaded. */
  async ready() {
    await this.page.waitForSelector('#engine[data-state="ready"]');
    return await this.page.textContent("#engine-words");
  }

  /** Chooses a device. @param {"auto" | "gpu" | "cpu"} device */
  async device(device) {
    await this.page.click(`label:has(input[name="device"][value="${device}"])`);
    return await this.ready();
  }

  /** Chooses a quality. @param {import("normalight").Quality} quality */
  async quality(quality) {
    await this.page.click(`label:has(input[name="quality"][value="${quality}"])`);
  }

  /** Chooses how many photographs are used. @param {"all" | "48" | "24" | "12"} images */
  async images(images) {
    await this.page.click(`label:has(input[name="images"][value="${images}"])`);
  }

  /** Hands files to the page as a user does. @param {import("./files.js").TestFile[]} files */
  async upload(files) {
    await this.page.setInputFiles(
      "#files",
      files.map(({ name, bytes }) => ({ name, mimeType: "", buffer: Buffer.from(bytes) })),
    );
  }

  /** Chooses a sample and waits until it is there. @param {{ name: string, photographs: string[] }} sample */
  async sample({ name, photographs }) {
    await this.page.click(`[data-sample="${name}"]`);
    await this.page.waitForSelector(`[data-sample="${name}"][aria-current="true"]`);
    await this.thumbnails(photographs.length + 1);
  }

  /** Estimates as quick as can be. */
  async quick() {
    await this.device("cpu");
    await this.quality("fast");
  }

  /** The result of twelve photographs of a sample, as quick as can be. @param {Parameters<Page["sample"]>[0]} sample */
  async estimateSample(sample) {
    await this.quick();
    await this.images("12");
    await this.sample(sample);
    assert.equal(await this.estimate(), "");
  }

  /** Chooses a file for a setting. @param {"mask" | "lights"} setting @param {import("./files.js").TestFile} file */
  async choose(setting, { name, bytes }) {
    const coming = this.page.waitForEvent("filechooser");
    // A click, as people do: the choice may be made already, for another file.
    await this.page.click(`label:has(input[name="${setting}"][value="file"])`);
    const chooser = await coming;
    await chooser.setFiles({ name, mimeType: "", buffer: Buffer.from(bytes) });
    await this.page.waitForSelector(`#${setting}-name:text-is("${name}")`);
  }

  /** Waits until as many thumbnails are there. @param {number} count */
  async thumbnails(count) {
    await this.page.waitForFunction(
      (expected) => document.querySelectorAll("#thumbnails [data-state]").length === expected,
      count,
    );
  }

  /** Presses the button and waits for the end; the words of a failure, or nothing. */
  async estimate() {
    await this.page.waitForSelector("#start:enabled");
    await this.during(() => this.page.click("#start"));
    return (await this.page.isVisible("#run-problem")) ? await this.page.textContent("#run-problem") : "";
  }

  /**
   * Does what begins a run and waits for its end, which may come before anybody could see that it has begun: something is said
   * then, and what was said before is taken away.
   * @param {() => Promise<unknown>} begin
   */
  async during(begin) {
    const says = ["status", "run-problem"];
    await this.page.evaluate((says) => {
      for (const id of says) document.getElementById(id)?.replaceChildren();
    }, says);
    await begin();
    await this.page.waitForFunction((says) => {
      const isSaid = says.some((id) => document.getElementById(id)?.textContent);
      return isSaid && !document.getElementById("start")?.hidden;
    }, says);
  }

  /** Downloads a file of the result. @param {string} name */
  async download(name) {
    const coming = this.page.waitForEvent("download");
    await this.page.click(`#downloads a[download="${name}"]`);
    const download = await coming;
    assert.equal(download.suggestedFilename(), name);
    return await readFile(await download.path());
  }

  /** Fails when something was wrong that the page did not show, such as a shader that does not compile. */
  assertQuiet() {
    assert.deepEqual(this.#complaints, []);
  }
}
