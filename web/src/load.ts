import init, * as wasm from "../wasm/normalight.js";

/** The module's functions. */
export type Module = typeof wasm;

/**
 * Fetches and starts the module.
 *
 * @param onLoad hears the share that has arrived
 * @param onPanic hears the words of a mistake after which the module is unusable
 */
export async function load(
  onLoad: (fraction: number) => void,
  onPanic: (message: string) => void,
): Promise<Module> {
  const response = await fetch(new URL("../wasm/normalight_bg.wasm", import.meta.url));
  if (!response.ok || response.body === null) {
    throw new Error(`the module cannot be loaded: ${response.status} ${response.statusText}`);
  }
  await init({ module_or_path: counted(response, response.body, onLoad) });
  wasm.start(onPanic);
  return wasm;
}

/** The same response, counted as it arrives. */
function counted(
  response: Response,
  body: ReadableStream<Uint8Array>,
  onLoad: (fraction: number) => void,
): Response {
  // A compressed transfer has fewer bytes than what arrives here.
  const expected = Number(response.headers.get("Content-Length")) || Number.POSITIVE_INFINITY;
  let received = 0;
  const counter = new TransformStream<Uint8Array, Uint8Array>({
    transform(chunk, controller) {
      received += chunk.byteLength;
      onLoad(Math.min(received / expected, 1));
      controller.enqueue(chunk);
    },
  });
  return new Response(body.pipeThrough(counter), { headers: response.headers });
}
