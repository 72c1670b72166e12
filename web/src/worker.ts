import type { Engine, InputFile } from "../wasm/normalight.js";
import { bytesOf, HEAD, read, readForPlan } from "./decode.js";
import { chooseDevice, cpu } from "./device.js";
import type { Thrown } from "./generated.js";
import { load, type Module } from "./load.js";
import type { FromWorker, TaskName, Tasks, ToWorker } from "./protocol.js";
import type { DeviceChoice, DeviceReport, StackFile } from "./types.js";
import { yieldToEvents } from "./yielding.js";

/** The part of a worker's global scope that is used here. */
interface Scope {
  postMessage(message: FromWorker, transfer: Transferable[]): void;
  addEventListener(type: "message", listener: (event: MessageEvent<ToWorker>) => void): void;
  addEventListener(type: "unhandledrejection", listener: (event: PromiseRejectionEvent) => void): void;
}

const scope = self as unknown as Scope;

let module: Promise<Module> | undefined;
let engine: Engine | undefined;
let cancelled = false;

scope.addEventListener("message", ({ data }) => {
  if (data.task === "cancel") cancelled = true;
  else void respond(data);
});

// Calls into the module that were under way when it broke down never end by themselves.
scope.addEventListener("unhandledrejection", ({ reason }) => crashed(String(reason)));

async function respond(message: Exclude<ToWorker, { task: "cancel" }>): Promise<void> {
  cancelled = false;
  try {
    const response = await perform(message);
    scope.postMessage({ event: "done", response }, buffers(response));
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) crashed(error.message);
    else tell({ event: "failed", ...failure(error) });
  }
}

async function perform(message: Exclude<ToWorker, { task: "cancel" }>): Promise<Tasks[TaskName]["response"]> {
  module ??= load((fraction) => tell({ event: "load", fraction }), crashed);
  const wasm = await module;
  switch (message.task) {
    case "create":
      return await create(wasm, message.request.device);
    case "plan":
      return wasm.plan(await Promise.all(message.request.files.map(readForPlan)));
    case "unpack":
      return await unpack(wasm, message.request.files);
    case "thumbnail": {
      const { file, color, side } = message.request;
      return wasm.thumbnail(await read(file), color, side);
    }
    case "mask": {
      const { files, mask, settings } = message.request;
      return wasm.objectMask(await readAll(files), mask && (await read(mask)), settings);
    }
    case "derive": {
      const { normals, albedo, settings } = message.request;
      return wasm.derive(normals, albedo, settings);
    }
    case "pictures":
      return wasm.normalPictures(message.request.normals, message.request.format);
    case "estimate":
      return await estimate(message.request);
  }
}

async function create(wasm: Module, choice: DeviceChoice): Promise<DeviceReport> {
  let device = await chooseDevice(choice, navigator.gpu);
  if (device.kind === "gpu") {
    try {
      engine = await wasm.Engine.on_gpu(device.name);
      return device;
    } catch (error) {
      device = cpu(`WebGPU does not start (${failure(error).message}), so the processor computes.`);
    }
  }
  engine = wasm.Engine.on_cpu(device.name);
  return device;
}

async function estimate(request: Tasks["estimate"]["request"]): Promise<Tasks["estimate"]["response"]> {
  if (engine === undefined) throw new Error("no device was chosen");
  const files = await readAll(request.files);
  const mask = request.mask && (await read(request.mask));
  const lights = request.lights && (await read(request.lights));
  return await engine.estimate(files, mask, lights, request.settings, {
    async report(stage, fraction: number): Promise<boolean> {
      tell({ event: "progress", stage, fraction });
      await yieldToEvents();
      return !cancelled;
    },
    plan(plan, words) {
      tell({ event: "plan", plan, words });
    },
  });
}

async function readAll(files: readonly StackFile[]): Promise<InputFile[]> {
  const contents: InputFile[] = [];
  for (const file of files) {
    contents.push(await read(file));
    if (cancelled) throw { kind: "cancelled", message: "cancelled" };
  }
  return contents;
}

async function unpack(wasm: Module, files: readonly StackFile[]): Promise<Tasks["unpack"]["response"]> {
  const plan = wasm.plan(await Promise.all(files.map(readForPlan)));
  // The pages of a single picture may be the photographs.
  if (plan.images.length > 1) return undefined;
  const unpacked: File[] = [];
  const archives: string[] = [];
  for (const file of files) {
    const archive = wasm.isArchive(file.name, await bytesOf(file, HEAD))
      ? wasm.Unpacked.open(await read(file))
      : undefined;
    if (archive === undefined) {
      unpacked.push(file instanceof File ? file : new File([file.bytes], file.name));
      continue;
    }
    try {
      // One file after the other, so that the module never holds all of them.
      for (const [index, name] of archive.names.entries()) {
        unpacked.push(new File([archive.take(index) as Uint8Array<ArrayBuffer>], name));
      }
    } finally {
      archive.free();
    }
    archives.push(file.name);
  }
  return archives.length > 0 ? { files: unpacked, archives } : undefined;
}

/** The module throws `{ kind, message }`; everything else is a surprise. */
function failure(error: unknown): Thrown {
  const { kind, message } = Object(error) as { kind?: unknown; message?: unknown };
  return {
    kind: kind === "input" || kind === "cancelled" ? kind : "device",
    message: typeof message === "string" ? message : String(error),
  };
}

function crashed(message: string): void {
  tell({ event: "crashed", message });
}

function tell(message: FromWorker): void {
  scope.postMessage(message, []);
}

/** The buffers in a response: they are handed over instead of copied. */
function buffers(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  return typeof value === "object" && value !== null ? Object.values(value).flatMap(buffers) : [];
}
