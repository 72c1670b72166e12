import type { Helper, InputFile } from "../wasm/normalight.js";
import { bytesOf, HEAD, read, readForPlan } from "./decode.js";
import { Engines } from "./engines.js";
import { messageOf } from "./errors.js";
import type { FailureKind, Thrown } from "./generated.js";
import { loadModule, type Module } from "./load.js";
import type { FromWorker, TaskName, Tasks, ToWorker } from "./protocol.js";
import type { Surroundings } from "./surroundings.js";
import type { DeviceReport, StackFile } from "./types.js";
import { yieldToEvents } from "./yielding.js";

/** Where messages come from and go to: a worker's global scope, a thread's port, or the page itself. */
export interface Scope {
  postMessage(message: FromWorker, transfer: ArrayBuffer[]): void;
  hear(listener: (message: ToWorker) => void): void;
}

/** What a served estimator can be told from outside. */
export interface Served {
  /** Says that the module is beyond repair. */
  crashed(message: string): void;
  /** Stops what is under way, and frees what the module holds. */
  stop(): void;
}

/** An estimator and its state. */
interface State {
  readonly scope: Scope;
  readonly surroundings: Surroundings;
  engines: Engines | undefined;
  /** What helps another worker's engines. */
  helper: Helper | undefined;
  cancelled: boolean;
  busy: boolean;
  stopped: boolean;
}

/** Answers the messages of a scope. */
export function serve(scope: Scope, surroundings: Surroundings): Served {
  const state: State = {
    scope,
    surroundings,
    engines: undefined,
    helper: undefined,
    cancelled: false,
    busy: false,
    stopped: false,
  };
  scope.hear((message) => {
    if (message.task === "cancel") state.cancelled = true;
    else void respond(state, message);
  });
  return {
    crashed: (message) => crashed(state, message, state.engines?.useGpu ?? false),
    stop() {
      state.cancelled = true;
      state.stopped = true;
      // The module refuses to free what is in use.
      if (!state.busy) release(state);
    },
  };
}

function release(state: State): void {
  state.engines?.free();
  state.engines = undefined;
  state.helper?.free();
  state.helper = undefined;
}

async function respond(state: State, message: Exclude<ToWorker, { task: "cancel" }>): Promise<void> {
  state.cancelled = state.stopped;
  state.busy = true;
  try {
    const response = await perform(state, message);
    state.scope.postMessage({ event: "done", response }, buffers(response));
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) crashed(state, error.message, usesGpu(state, message));
    else tell(state, { event: "failed", ...failure(error) });
  } finally {
    state.busy = false;
    if (state.stopped) release(state);
  }
}

function usesGpu(state: State, { task }: ToWorker): boolean {
  return task === "estimate" && (state.engines?.useGpu ?? false);
}

async function perform(
  state: State,
  message: Exclude<ToWorker, { task: "cancel" }>,
): Promise<Tasks[TaskName]["response"]> {
  if (message.task === "create") return await create(state, message.request);
  if (message.task === "help") return await help(state, message.request);
  const { engines, helper } = state;
  if (message.task === "features") {
    if (helper === undefined) throw new Error("this is no helper");
    return await helper.features(message.request.shapes, message.request.values);
  }
  if (engines === undefined) throw new Error("nothing was loaded");
  const wasm = engines.module;
  switch (message.task) {
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
      return wasm.objectMask(await readAll(state, files), mask && (await read(mask)), settings);
    }
    case "derive": {
      const { normals, albedo, settings } = message.request;
      return wasm.derive(normals, albedo, settings);
    }
    case "pictures":
      return wasm.normalPictures(message.request.normals, message.request.format);
    case "estimate":
      return await estimate(state, engines, message.request);
  }
}

async function create(state: State, request: Tasks["create"]["request"]): Promise<DeviceReport> {
  const { engines, device } = await Engines.create(request, state.surroundings, {
    load: (progress) => tell(state, { event: "load", ...progress }),
    device: (device) => tell(state, { event: "device", device }),
    crashed: (words, gpu) => crashed(state, words, gpu),
  });
  state.engines = engines;
  return device;
}

async function help(state: State, { module, normal }: Tasks["help"]["request"]): Promise<undefined> {
  const onPanic = (words: string) => crashed(state, words, false);
  const loaded = await loadModule(state.surroundings.fetchAsset, module, undefined, onPanic);
  state.helper = new loaded.module.Helper(normal);
}

async function estimate(
  state: State,
  engines: Engines,
  request: Tasks["estimate"]["request"],
): Promise<Tasks["estimate"]["response"]> {
  const files = await readAll(state, request.files);
  const mask = request.mask && (await read(request.mask));
  const lights = request.lights && (await read(request.lights));
  return await engines.estimate(files, mask, lights, request.settings, {
    async report(stage, fraction: number): Promise<boolean> {
      tell(state, { event: "progress", stage, fraction });
      await yieldToEvents();
      return !state.cancelled;
    },
    plan(plan, words) {
      tell(state, { event: "plan", plan, words });
    },
  });
}

async function readAll(state: State, files: readonly StackFile[]): Promise<InputFile[]> {
  const contents: InputFile[] = [];
  for (const file of files) {
    contents.push(await read(file));
    if (state.cancelled) throw { kind: "cancelled", message: "cancelled" };
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
  const names = unpacked.map(({ name }) => name);
  return archives.length > 0 ? { files: unpacked, names, archives } : undefined;
}

/** The module throws `{ kind, message }`; everything else is a surprise. */
function failure(error: unknown): Omit<Thrown, "kind"> & { kind: FailureKind | "load" } {
  const { kind } = Object(error) as { kind?: unknown };
  return {
    kind: kind === "input" || kind === "cancelled" || kind === "load" ? kind : "device",
    message: messageOf(error),
  };
}

function crashed(state: State, message: string, gpu: boolean): void {
  tell(state, { event: "crashed", message, gpu });
}

function tell(state: State, message: FromWorker): void {
  state.scope.postMessage(message, []);
}

/** The buffers in a response: they are handed over instead of copied. */
function buffers(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  return typeof value === "object" && value !== null ? Object.values(value).flatMap(buffers) : [];
}
