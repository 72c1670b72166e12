// What the bench does in the page: the package and ONNX Runtime on the same photographs.
import { Normalight } from "../dist/index.js";

/** A matte ball under lights on a ring, as linear floats. @param {number} images @param {number} side */
function photographs(images, side) {
  return Array.from({ length: images }, (_, image) => {
    const angle = (2 * Math.PI * image) / images;
    const light = [0.6 * Math.cos(angle), 0.6 * Math.sin(angle), 0.8];
    const data = new Float32Array(side * side * 3);
    for (let pixel = 0; pixel < side * side; pixel++) {
      const [x, y] = [((pixel % side) + 0.5) / side, (Math.floor(pixel / side) + 0.5) / side];
      const [nx, ny] = [1.4 * (x - 0.5), 1.4 * (0.5 - y)];
      const nz = Math.sqrt(1 - nx * nx - ny * ny);
      const shade = Math.max(0, nx * light[0] + ny * light[1] + nz * light[2]);
      data.fill(0.05 + 0.6 * shade, 3 * pixel, 3 * pixel + 3);
    }
    return { data, width: side, height: side, channels: 3 };
  });
}

/** Seconds that work takes. @param {() => Promise<unknown>} work */
async function seconds(work) {
  const start = performance.now();
  await work();
  return (performance.now() - start) / 1000;
}

/** The package: stages as its report has them, preparation of the networks' inputs included. @param {"cpu" | "gpu"} device @param {number} threads */
async function ours(device, threads) {
  const normalight = await Normalight.create({ device, threads });
  if (normalight.device.kind !== device) throw new Error(normalight.device.notice);
  return async (images, side) => {
    const options = { quality: "fast", refit: false, mask: "none" };
    const { files } = await normalight.estimate(photographs(images, side), options);
    const report = files.find(({ name }) => name === "report.json");
    const stages = JSON.parse(new TextDecoder().decode(report.bytes)).seconds;
    const of = (name) => stages.find(({ stage }) => stage === name).seconds;
    return { lights: of("lights"), normals: of("normals") };
  };
}

/**
 * ONNX Runtime: the networks alone, on inputs that are ready.
 *
 * @param {string} build file of the runtime
 * @param {string} provider
 * @param {number} threads
 */
async function theirs(build, provider, threads) {
  // Threads are chosen once an instance of the module; another address is another instance.
  const address = `/node_modules/onnxruntime-web/dist/${build}?threads=${threads}`;
  const { env, InferenceSession, Tensor } = await import(address);
  env.wasm.numThreads = threads;
  const load = async (network) => {
    const model = await (await fetch(`/models/${network}.onnx`)).arrayBuffer();
    return await InferenceSession.create(new Uint8Array(model), { executionProviders: [provider] });
  };
  const [light, normal] = [await load("light"), await load("normal")];
  const run = (session, shape) => {
    const values = new Float32Array(shape.reduce((all, length) => all * length)).fill(0.5);
    return seconds(() => session.run({ images: new Tensor("float32", values, shape) }));
  };
  return async (images, side) => ({
    lights: await run(light, [images, 4, 64, 64]),
    normals: await run(normal, [images, 6, side, side]),
  });
}

/** Who can take part here. */
globalThis.contenders = async () => {
  const adapter = await navigator.gpu?.requestAdapter();
  const { vendor = "", architecture = "", description = "", isFallbackAdapter = false } = adapter?.info ?? {};
  return {
    isolated: crossOriginIsolated,
    cores: navigator.hardwareConcurrency,
    adapter: adapter ? [vendor, architecture, description].filter(Boolean).join(" ") : null,
    software: isFallbackAdapter || /swiftshader|llvmpipe|software/i.test(`${architecture} ${description}`),
  };
};

const START = {
  "normalight, 1 thread": () => ours("cpu", 1),
  "normalight, 2 threads": () => ours("cpu", 2),
  "normalight, WebGPU": () => ours("gpu", 1),
  "onnxruntime-web, wasm, 1 thread": () => theirs("ort.wasm.min.mjs", "wasm", 1),
  "onnxruntime-web, wasm, 2 threads": () => theirs("ort.wasm.min.mjs", "wasm", 2),
  "onnxruntime-web, WebGPU": () => theirs("ort.webgpu.min.mjs", "webgpu", 1),
};
globalThis.names = Object.keys(START);

/** Started once, used in all rounds. @type {Record<string, Awaited<ReturnType<typeof ours>>>} */
const started = {};

/** Seconds of both networks, once. @param {string} name @param {number} images @param {number} side */
globalThis.timed = async (name, images, side) => {
  started[name] ??= await START[name]();
  return await started[name](images, side);
};
globalThis.isReady = true;
