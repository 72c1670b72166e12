import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { fileURLToPath } from "node:url";
import { typeOf } from "../../../web/test/support/server.js";

const BUILD = fileURLToPath(new URL("../../dist/", import.meta.url));

/** A plain server with the built page in one of its folders, which can go away. */
export class Host {
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
      const content = path && (await readFile(BUILD + path).catch(() => undefined));
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
}
