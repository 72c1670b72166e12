import type { FeatureParcel, InputFile } from "../wasm/normalight.js";
import type { Addresses } from "./assets.js";
import type { DerivedSettings, FailureKind, Settings } from "./generated.js";
import type {
  ColorMode,
  Derived,
  DeviceChoice,
  DeviceReport,
  Estimate,
  FloatMap,
  InputPlan,
  LoadProgress,
  NormalFormat,
  NormalPictures,
  ObjectMask,
  Plan,
  StackFile,
  Stage,
  Thumbnail,
  UnpackedArchives,
} from "./types.js";

/** Between threads of Node.js files lose their names. */
export interface Unpacked extends UnpackedArchives {
  readonly names: readonly string[];
}

/** What the worker can be asked to do: the request and the response of each task. */
export interface Tasks {
  create: {
    request: { device: DeviceChoice; threads: number | undefined } & Addresses;
    response: DeviceReport;
  };
  /** Becomes a helper, with a module that another thread has compiled. */
  help: { request: { module: WebAssembly.Module; normal: InputFile }; response: undefined };
  features: { request: { shapes: Uint32Array; values: Float32Array }; response: FeatureParcel };
  plan: { request: { files: readonly StackFile[] }; response: Plan };
  unpack: { request: { files: readonly StackFile[] }; response: Unpacked | undefined };
  thumbnail: { request: { file: StackFile; color: ColorMode; side: number }; response: Thumbnail };
  mask: {
    request: { files: readonly StackFile[]; mask: StackFile | undefined; settings: Settings };
    response: ObjectMask;
  };
  derive: {
    request: { normals: FloatMap; albedo: FloatMap | undefined; settings: DerivedSettings };
    response: Derived;
  };
  pictures: { request: { normals: FloatMap; format: NormalFormat }; response: NormalPictures };
  estimate: {
    request: {
      files: readonly StackFile[];
      mask: StackFile | undefined;
      lights: StackFile | undefined;
      settings: Required<Settings>;
    };
    response: Estimate;
  };
}

/** The name of a task. */
export type TaskName = keyof Tasks;

/** To the worker: one task, or the wish to stop the one under way. */
export type ToWorker =
  | { [T in TaskName]: { task: T; request: Tasks[T]["request"] } }[TaskName]
  | { task: "cancel" };

/**
 * From the worker: the lock that it holds as long as it lives, another device than was said, events while a task runs, its end, or that a module is beyond repair (`gpu`: perhaps
 * because of the GPU). */
export type FromWorker =
  | ({ event: "load" } & LoadProgress)
  | { event: "alive"; lock: string }
  | { event: "device"; device: DeviceReport }
  | { event: "progress"; stage: Stage; fraction: number }
  | { event: "plan"; plan: InputPlan; words: string[] }
  | { event: "done"; response: Tasks[TaskName]["response"] }
  | { event: "failed"; kind: FailureKind | "load"; message: string }
  | { event: "crashed"; message: string; gpu: boolean };
