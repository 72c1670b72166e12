import type { LoadProgress } from "./types.js";

/** Fetches a file from an address; past every cache when that was asked for. */
export type FetchAsset = (url: string, fresh: boolean) => Promise<Response>;

/** Counts what arrives of several files, and tells it in one. */
export class Arrivals {
  readonly #onLoad: (progress: LoadProgress) => void;
  readonly #files = new Map<string, { bytes: number; expected: number }>();

  /** @param urls what will be fetched */
  constructor(urls: readonly string[], onLoad: (progress: LoadProgress) => void) {
    this.#onLoad = onLoad;
    for (const url of urls) this.#files.set(url, { bytes: 0, expected: Number.POSITIVE_INFINITY });
  }

  /** The same response, counted as it arrives. */
  counted(url: string, response: Response, body: ReadableStream<Uint8Array>): Response {
    // A compressed transfer has fewer bytes than what arrives here.
    const file = {
      bytes: 0,
      expected: Number(response.headers.get("Content-Length")) || Number.POSITIVE_INFINITY,
    };
    this.#files.set(url, file);
    const counter = new TransformStream<Uint8Array, Uint8Array>({
      transform: (chunk, controller) => {
        file.bytes += chunk.byteLength;
        this.#tell();
        controller.enqueue(chunk);
      },
    });
    // Servers that do not know the type must not keep a module from compiling while it arrives.
    return new Response(body.pipeThrough(counter), { headers: { "Content-Type": "application/wasm" } });
  }

  #tell(): void {
    let [bytes, expected] = [0, 0];
    for (const file of this.#files.values()) {
      bytes += file.bytes;
      expected += file.expected;
    }
    this.#onLoad({ bytes, fraction: Math.min(bytes / expected, 1) });
  }
}

/**
 * A file, used while it arrives; fetched twice if need be, because a cache may hold half of it, and Chromium's fails when two
 * ask at once for more than it takes.
 *
 * @throws `load` with the address and what went wrong, in words rather than in those of a compiler
 */
export async function fetched<T>(
  fetchAsset: FetchAsset,
  url: string,
  arrivals: Arrivals | undefined,
  use: (response: Response) => Promise<T>,
): Promise<T> {
  const attempt = async (fresh: boolean) => {
    const response = await fetchAsset(url, fresh);
    if (!response.ok || response.body === null) {
      throw new Error(`the server answers ${response.status} ${response.statusText}`.trim());
    }
    return await use(arrivals?.counted(url, response, response.body) ?? response);
  };
  try {
    try {
      return await attempt(false);
    } catch (error) {
      if (!(error instanceof TypeError || error instanceof WebAssembly.CompileError)) throw error;
      return await attempt(true);
    }
  } catch (error) {
    throw { kind: "load", message: `${url} cannot be loaded: ${reason(error)}` };
  }
}

function reason(error: unknown): string {
  const message = error instanceof Error ? error.message : String(error);
  if (error instanceof WebAssembly.CompileError)
    return `what arrived is no module or a damaged one (${message})`;
  if (error instanceof WebAssembly.LinkError) return `the module is of another version (${message})`;
  if (error instanceof TypeError) return `it cannot be fetched or ended too early (${message})`;
  return message;
}
