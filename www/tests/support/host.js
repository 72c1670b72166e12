import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { fileURLToPath } from "node:url";
import { typeOf } from "../../../web/test/support/server.js";

const BUILD = fileURLToPath(new URL("../../dist/", import.meta.url));

/** A plain server with the built page in one of its folders, which can go away and get another build. */
export class Host {
  /** Files in place of those of the build. @type {Map<string, string>} */
  files = new Map();
  /** Whether there is no answer. */
  down = false;
  /** Requests that got here. */
  asked = 0;

  static async start() {
    const host = new Host();
    const server = createServer(async ({ url = "" }, response) => {
      host.asked += 1;
      if (host.down) return response.destroy();
      const path = host.path(url);
      const content = path && (host.files.get(path) ?? (await readFile(BUILD + path).catch(() => undefined)));
      if (!path || content === undefined) return response.writeHead(404).end("not found");
      // Whoever asks from elsewhere may: only the page's own policy keeps it from asking.
      const headers = { "Cache-Control": "max-age=600", "Access-Control-Allow-Origin": "*" };
      response.writeHead(200, { ...headers, "Content-Type": typeOf(path) }).end(content);
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(undefined)));
    const address = /** @type {import("node:net").AddressInfo} */ (server.address());
    host.port = address.port;
    host.close = () => {
      server.closeAllConnections();
      server.close();
    };
    return host;
  }

  port = 0;
  close = () => {};

  /** The page's folder. */
  get address() {
    return `http://127.0.0.1:${this.port}/some/folder/`;
  }

  /** @param {string} url */
  path(url) {
    const [, path] = /^\/some\/folder\/([^?]*)/.exec(url) ?? [];
    return path === "" ? "index.html" : path;
  }

  /** Puts another version of the page there: its title says so. @param {string} title */
  async build(title) {
    const [page, worker] = await Promise.all(
      ["index.html", "service-worker.js"].map((name) => readFile(BUILD + name, "utf8")),
    );
    const next = (page ?? "").replace(">Normalight</title>", `>${title}</title>`);
    assert.notEqual(next, page, "the page has another title");
    this.files.set("index.html", next);
    this.files.set("service-worker.js", (worker ?? "").replace(await hash(page ?? ""), await hash(next)));
  }
}

/** @param {string} text */
async function hash(text) {
  const bytes = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text));
  return Buffer.from(bytes).toString("base64");
}
