import assert from "node:assert/strict";
import { test } from "node:test";
import { chooseDevice } from "../dist/device.js";

/** A browser's WebGPU with this adapter. @param {object | null} info */
const gpu = (info) => ({
  requestAdapter: async () => info && { info: { description: "", vendor: "", ...info } },
});

test("automatic takes a real GPU", async () => {
  const device = await chooseDevice("auto", gpu({ vendor: "intel", architecture: "gen-12lp" }));
  assert.deepEqual(device, { kind: "gpu", name: "GPU (WebGPU, intel gen-12lp)" });
});

test("automatic never takes a software adapter, but who asks for it gets it", async () => {
  for (const info of [
    { vendor: "google", architecture: "swiftshader" },
    { description: "llvmpipe (LLVM 17.0)" },
    { description: "Microsoft Basic Render Driver" },
    { vendor: "amd", isFallbackAdapter: true },
  ]) {
    const device = await chooseDevice("auto", gpu(info));
    assert.equal(device.kind, "cpu");
    assert.match(device.notice ?? "", /software adapter/);
    assert.equal((await chooseDevice("gpu", gpu(info))).kind, "gpu");
  }
});

test("without WebGPU the processor steps in and says why", async () => {
  const fails = { requestAdapter: () => Promise.reject(new Error("blocked")) };
  for (const [browser, words] of [
    [undefined, /no WebGPU/],
    [gpu(null), /no graphics adapter/],
    [fails, /blocked/],
  ]) {
    for (const choice of ["auto", "gpu"]) {
      const device = await chooseDevice(choice, browser);
      assert.equal(device.kind, "cpu");
      assert.match(device.notice ?? "", words);
    }
  }
  assert.equal((await chooseDevice("cpu", undefined)).notice, undefined);
});
