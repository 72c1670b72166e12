import type { WeightsSource } from "./types.js";

/** Where the files lie that are fetched when they are needed. */
export interface Assets {
  /** The module for the processor, and for all that needs no device. */
  readonly module: string;
  /** The module for the GPU. */
  readonly gpuModule: string;
  /** The networks' weights; whether they must be the ones that ship. */
  readonly weights: { readonly light: string; readonly normal: string; readonly shipped: boolean };
}

/** What of it may be said from outside, as addresses that hold everywhere. */
export interface Addresses {
  readonly wasmUrl: string | undefined;
  readonly weights: WeightsSource<string> | undefined;
}

/** Everything lies where this package brings it, or beside the module. */
export function assets({ wasmUrl, weights }: Addresses): Assets {
  const beside = (name: string) => wasmUrl && new URL(name, wasmUrl).href;
  // Literals, so that bundlers find the files.
  return {
    module: wasmUrl ?? new URL("../wasm/normalight_bg.wasm", import.meta.url).href,
    gpuModule:
      beside("normalight_gpu_bg.wasm") ?? new URL("../wasm/normalight_gpu_bg.wasm", import.meta.url).href,
    weights: {
      light:
        weights?.light ??
        beside("light.safetensors") ??
        new URL("../wasm/light.safetensors", import.meta.url).href,
      normal:
        weights?.normal ??
        beside("normal.safetensors") ??
        new URL("../wasm/normal.safetensors", import.meta.url).href,
      shipped: weights === undefined,
    },
  };
}
