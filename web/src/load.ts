import init, * as wasm from "../wasm/normalight.js";
import type { LoadProgress } from "./types.js";

/** The module's functions. */
export type Module = typeof wasm;

/** Fetches the module from an address; past every cache when that was asked for. */
export type FetchModule = (url: string, fresh: boolean) => Promise<Response>;

/** The module of this thread, as soon as it was asked for. */
let loaded: Promise<void> | undefined;
/** The words of the mistake after which it is unusable. */
let broken: string | undefined;
const panicListeners = new Set<(message: string) => void>();

/**
 * Fetches and starts the module; on the main thread several estimators share one.
 *
 * @param url where it lies, if not where this package brings it
 * @param onLoad hears how much has arrived
 * @param onPanic hears the words of a mistake after which the module is unusable
 */
export async function load(
  fetchModule: FetchModule,
  url: string | undefined,
  onLoad: (progress: LoadProgress) => void,
  onPanic: (message: string) => void,
): Promise<Module> {
  if (broken !== undefined) throw { kind: "load", message: `the module broke before: ${broken}` };
  loaded ??= start(fetchModule, url, onLoad);
  try {
    await loaded;
  } catch (error) {
    loaded = undefined;
    throw error;
  }
  panicListeners.add(onPanic);
  return wasm;
}

async function start(
  fetchModule: FetchModule,
  url: string | undefined,
  onLoad: (progress: LoadProgress) => void,
): Promise<void> {
  // A literal, so that bundlers find the module.
  const address = url ?? new URL("../wasm/normalight_bg.wasm", import.meta.url).href;
  try {
    const module = await compile(fetchModule, address, onLoad);
    // Before it is taken: a module cannot be exchanged for another.
    if (!WebAssembly.Module.exports(module).some(({ name }) => name === "start")) {
      throw new WebAssembly.LinkError("it has no start");
    }
    await init({ module_or_path: module });
  } catch (error) {
    throw { kind: "load", message: `${address} cannot be loaded: ${reason(error)}` };
  }
  wasm.start((message: string) => {
    broken = message;
    for (const listener of panicListeners) listener(message);
  });
}

/**
 * The module, compiled while it arrives; fetched twice if need be, because a cache may hold half of it, and Chromium's fails
 * when two ask at once for more than it takes.
 */
async function compile(
  fetchModule: FetchModule,
  address: string,
  onLoad: (progress: LoadProgress) => void,
): Promise<WebAssembly.Module> {
  const attempt = async (fresh: boolean) => {
    const response = await fetchModule(address, fresh);
    if (!response.ok || response.body === null) {
      throw new Error(`the server answers ${response.status} ${response.statusText}`.trim());
    }
    return await WebAssembly.compileStreaming(counted(response, response.body, onLoad));
  };
  try {
    return await attempt(false);
  } catch (error) {
    if (!(error instanceof TypeError || error instanceof WebAssembly.CompileError)) throw error;
    return await attempt(true);
  }
}

/** What went wrong, in words rather than in those of a compiler. */
function reason(error: unknown): string {
  const message = error instanceof Error ? error.message : String(error);
  if (error instanceof WebAssembly.CompileError)
    return `what arrived is no module or a damaged one (${message})`;
  if (error instanceof WebAssembly.LinkError) return `the module is of another version (${message})`;
  if (error instanceof TypeError) return `it cannot be fetched or ended too early (${message})`;
  return message;
}

/** The same response, counted as it arrives. */
function counted(
  response: Response,
  body: ReadableStream<Uint8Array>,
  onLoad: (progress: LoadProgress) => void,
): Response {
  // A compressed transfer has fewer bytes than what arrives here.
  const expected = Number(response.headers.get("Content-Length")) || Number.POSITIVE_INFINITY;
  let bytes = 0;
  const counter = new TransformStream<Uint8Array, Uint8Array>({
    transform(chunk, controller) {
      bytes += chunk.byteLength;
      onLoad({ bytes, fraction: Math.min(bytes / expected, 1) });
      controller.enqueue(chunk);
    },
  });
  // Servers that do not know the type must not keep the module from compiling while it arrives.
  return new Response(body.pipeThrough(counter), { headers: { "Content-Type": "application/wasm" } });
}
