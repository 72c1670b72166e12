import type { Engine, InputFile } from "../wasm/normalight.js";
import type { Engine as GpuEngine } from "../wasm/normalight_gpu.js";
import { type Assets, assets } from "./assets.js";
import { chooseDevice, cpu } from "./device.js";
import { messageOf } from "./errors.js";
import { Arrivals, fetched } from "./fetch.js";
import { Helpers, threadCount } from "./helpers.js";
import { loadGpuModule, loadModule, type Module } from "./load.js";
import type { Tasks } from "./protocol.js";
import type { Surroundings } from "./surroundings.js";
import type { DeviceReport, LoadProgress } from "./types.js";

/** Who hears what happens beside the tasks. */
export interface Listener {
  load(progress: LoadProgress): void;
  /** What computes is another device than was said. */
  device(report: DeviceReport): void;
  /** A module is beyond repair; `gpu`: the one for the GPU. */
  crashed(words: string, gpu: boolean): void;
}

/** Photographs, and all that is said of them. */
type Request = [
  files: InputFile[],
  mask: InputFile | undefined,
  lights: InputFile | undefined,
  settings: Tasks["estimate"]["request"]["settings"],
  callback: Parameters<Engine["estimate"]>[4],
];

/**
 * The module for the processor, which is there at once and steps in, and the one for the GPU, which arrives in the background
 * where there is a GPU.
 */
export class Engines {
  /** What needs no device. */
  readonly module: Module;
  readonly #cpu: Engine;
  readonly #listener: Listener;
  readonly #startHelpers: () => Helpers;
  #helpers: Helpers | undefined;
  #gpu: Promise<GpuEngine> | undefined;
  #stopped = false;

  private constructor(module: Module, cpu: Engine, listener: Listener, startHelpers: () => Helpers) {
    this.module = module;
    this.#cpu = cpu;
    this.#listener = listener;
    this.#startHelpers = startHelpers;
  }

  /** Fetches what `request` asks for, and says what will compute. */
  static async create(
    { device: choice, threads, ...addresses }: Tasks["create"]["request"],
    surroundings: Surroundings,
    listener: Listener,
  ): Promise<{ engines: Engines; device: DeviceReport }> {
    const { fetchAsset, cores } = surroundings;
    const helpers = threadCount(threads, cores) - 1;
    const from = assets(addresses);
    const { light, normal, shipped } = from.weights;
    const arrivals = new Arrivals([from.module, light, normal], listener.load);
    const crashed = (words: string) => listener.crashed(words, false);
    const weights = (url: string) =>
      fetched(fetchAsset, url, arrivals, async (response) => ({
        name: url,
        bytes: new Uint8Array(await response.arrayBuffer()),
      }));
    const files = Promise.all([weights(light), weights(normal)]);
    // Where all is missing, the module is named.
    files.catch(() => undefined);
    const [{ module, compiled }, device] = await Promise.all([
      loadModule(fetchAsset, from.module, arrivals, crashed),
      // Node.js has no navigator before version 21.
      chooseDevice(choice, globalThis.navigator?.gpu),
    ]);
    const [lightFile, normalFile] = await files;
    const engines = new Engines(
      module,
      onCpu(module, lightFile, normalFile, shipped),
      listener,
      () => new Helpers(helpers, surroundings, { module: compiled, normal: normalFile }),
    );
    if (device.kind === "gpu") engines.#start(device, from, [lightFile, normalFile], surroundings);
    return { engines, device };
  }

  /** Fetches and starts the GPU in the background; if that fails, the processor computes. */
  #start(
    device: DeviceReport,
    from: Assets,
    weights: [InputFile, InputFile],
    { fetchAsset }: Surroundings,
  ): void {
    const {
      gpuModule,
      weights: { shipped },
    } = from;
    const crashed = (words: string) => this.#listener.crashed(words, true);
    const starting = loadGpuModule(fetchAsset, gpuModule, undefined, crashed).then(({ module }) =>
      module.Engine.on_gpu(device.name, ...weights, shipped),
    );
    this.#gpu = starting;
    starting.then(
      (engine) => this.#stopped && engine.free(),
      (error: unknown) =>
        this.#giveUpGpu(`WebGPU does not start (${messageOf(error)}), so the processor computes.`),
    );
  }

  /** Whether estimates are the GPU's. */
  get useGpu(): boolean {
    return this.#gpu !== undefined;
  }

  #giveUpGpu(notice: string): void {
    this.#gpu = undefined;
    this.#listener.device(cpu(notice));
  }

  /** Estimates on the GPU, if there is one, and on the processor if the GPU fails. */
  async estimate(...request: Request): Promise<Tasks["estimate"]["response"]> {
    const gpu = await this.#gpu?.catch(() => undefined);
    if (gpu === undefined) return await this.#onCpu(...request);
    try {
      return { ...(await gpu.estimate(...request)), threads: 1 };
    } catch (error) {
      if (Object(error).kind !== "device") throw error;
      this.#giveUpGpu(`The GPU failed (${messageOf(error)}), so the processor computes.`);
      return await this.#onCpu(...request);
    }
  }

  async #onCpu(...request: Request): Promise<Tasks["estimate"]["response"]> {
    this.#helpers ??= this.#startHelpers();
    const found = await this.#cpu.estimate(...request, this.#helpers);
    return { ...found, threads: 1 + this.#helpers.count };
  }

  /** Gives the memory of the networks back. */
  free(): void {
    this.#stopped = true;
    this.#helpers?.free();
    this.#cpu.free();
    this.#gpu?.then(
      (engine) => engine.free(),
      () => undefined,
    );
    this.#gpu = undefined;
  }
}

/** The engine that is always there: by making it the weights are checked. */
function onCpu(module: Module, light: InputFile, normal: InputFile, shipped: boolean): Engine {
  try {
    return module.Engine.on_cpu(cpu().name, light, normal, shipped);
  } catch (error) {
    if (Object(error).kind !== "device") throw error;
    throw { kind: "load", message: messageOf(error) };
  }
}
