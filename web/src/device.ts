import type { DeviceChoice, DeviceReport } from "./types.js";

/** Names by which adapters that compute on the processor give themselves away. */
const SOFTWARE = /swiftshader|llvmpipe|lavapipe|softpipe|software|basic render|\bwarp\b/i;

/** The processor's name in reports. */
const CPU = "CPU (flex, WebAssembly)";

/** The processor, and why not a GPU. */
export function cpu(notice?: string): DeviceReport {
  return notice === undefined ? { kind: "cpu", name: CPU } : { kind: "cpu", name: CPU, notice };
}

/** Decides what computes, by asking the browser for an adapter: that `navigator.gpu` exists means little. */
export async function chooseDevice(choice: DeviceChoice, gpu: GPU | undefined): Promise<DeviceReport> {
  if (choice === "cpu") return cpu();
  if (gpu === undefined) {
    return cpu("There is no WebGPU here, so the processor computes.");
  }
  let adapter: GPUAdapter | null;
  try {
    adapter = await gpu.requestAdapter({ powerPreference: "high-performance" });
  } catch (error) {
    return cpu(`WebGPU does not start (${error}), so the processor computes.`);
  }
  if (adapter === null) {
    return cpu("WebGPU finds no graphics adapter here, so the processor computes.");
  }
  const name = adapterName(adapter.info);
  if (choice === "auto" && (adapter.info.isFallbackAdapter || SOFTWARE.test(name))) {
    return cpu(`WebGPU only has a software adapter here (${name}): the processor itself is faster.`);
  }
  return { kind: "gpu", name: `GPU (WebGPU, ${name})` };
}

function adapterName({ description, vendor, architecture, device }: GPUAdapterInfo): string {
  return description || [vendor, architecture, device].filter(Boolean).join(" ") || "unnamed adapter";
}
