import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";

/** @type {Record<string, string>} */
const TYPES = {
  ".css": "text/css",
  ".html": "text/html",
  ".js": "text/javascript",
  ".json": "application/json",
  ".mjs": "text/javascript",
  ".png": "image/png",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".webmanifest": "application/manifest+json",
};

/** The type by which servers send a file; one without an extension is a page. @param {string} path */
export function typeOf(path) {
  return TYPES[extname(path) || ".html"] ?? "application/octet-stream";
}

/**
 * @callback Misbehaviour answers by itself, or says nothing
 * @param {string} path
 * @param {import("node:http").ServerResponse} response
 * @returns {boolean | Promise<boolean>} whether it has answered
 */

/**
 * A server of the files in a folder, for pages of any origin.
 *
 * @param {string} folder
 * @param {Misbehaviour} [misbehave]
 */
export async function serve(folder, misbehave = () => false) {
  const server = createServer(async (request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url ?? "/", "http://a").pathname));
    response.setHeader("Access-Control-Allow-Origin", "*");
    if (await misbehave(path, response)) return;
    try {
      const file = path.endsWith("/") ? `${path}index.html` : path;
      const bytes = await readFile(join(folder, file));
      response.writeHead(200, { "Content-Type": typeOf(file), "Content-Length": bytes.length }).end(bytes);
    } catch {
      response.writeHead(404).end("not there");
    }
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", () => listening(undefined)));
  const address = server.address();
  const port = typeof address === "object" && address !== null ? address.port : 0;
  return {
    url: `http://127.0.0.1:${port}/`,
    close() {
      server.closeAllConnections();
      server.close();
    },
  };
}
