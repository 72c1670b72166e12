import initCpu, * as cpu from "../wasm/normalight.js";
import initGpu, * as gpu from "../wasm/normalight_gpu.js";
import { type Arrivals, type FetchAsset, fetched } from "./fetch.js";

/** The functions of the module that computes on the processor, and does all that needs no device. */
export type Module = typeof cpu;

/** The functions of the module that computes on the GPU. */
export type GpuModule = typeof gpu;

/**
 * Fetches and starts a module; on the main thread several estimators share one.
 *
 * @param source where it lies, or what another thread has compiled
 * @param arrivals counts what has arrived
 * @param onPanic hears the words of a mistake after which the module is unusable
 */
export type Load<M> = (
  fetchAsset: FetchAsset,
  source: string | WebAssembly.Module,
  arrivals: Arrivals | undefined,
  onPanic: (message: string) => void,
) => Promise<{ module: M; compiled: WebAssembly.Module }>;

export const loadModule: Load<Module> = loader(cpu, initCpu);
export const loadGpuModule: Load<GpuModule> = loader(gpu, initGpu);

function loader<M extends { start(onPanic: (message: string) => void): void }>(
  glue: M,
  init: (options: { module_or_path: WebAssembly.Module }) => Promise<unknown>,
): Load<M> {
  /** The module of this thread, as soon as it was asked for. */
  let loaded: Promise<WebAssembly.Module> | undefined;
  /** The words of the mistake after which it is unusable. */
  let broken: string | undefined;
  const panicListeners = new Set<(message: string) => void>();

  async function take(module: WebAssembly.Module): Promise<WebAssembly.Module> {
    // Before it is taken: a module cannot be exchanged for another.
    if (!WebAssembly.Module.exports(module).some(({ name }) => name === "start")) {
      throw new WebAssembly.LinkError("it has no start");
    }
    await init({ module_or_path: module });
    return module;
  }

  async function start(
    fetchAsset: FetchAsset,
    source: string | WebAssembly.Module,
    arrivals: Arrivals | undefined,
  ): Promise<WebAssembly.Module> {
    const compiled =
      typeof source === "string"
        ? await fetched(fetchAsset, source, arrivals, async (response) =>
            take(await WebAssembly.compileStreaming(response)),
          )
        : await take(source);
    glue.start((message: string) => {
      broken = message;
      for (const listener of panicListeners) listener(message);
    });
    return compiled;
  }

  return async (fetchAsset, source, arrivals, onPanic) => {
    if (broken !== undefined) throw { kind: "load", message: `the module broke before: ${broken}` };
    loaded ??= start(fetchAsset, source, arrivals);
    try {
      const compiled = await loaded;
      panicListeners.add(onPanic);
      return { module: glue, compiled };
    } catch (error) {
      loaded = undefined;
      throw error;
    }
  };
}
