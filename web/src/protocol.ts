import type {
  ColorMode,
  DeviceChoice,
  DeviceReport,
  Estimate,
  Plan,
  Quality,
  StackFile,
  Stage,
  Thumbnail,
} from "./types.js";

/** Settings that the module understands, without files and functions. */
export interface Settings {
  color: ColorMode;
  mask: "auto" | "none";
  images: number | undefined;
  normalFormat: "opengl" | "directx";
  refit: boolean;
  quality: Quality;
}

/** What the worker can be asked to do: the arguments and the answer of each task. */
export interface Tasks {
  create: { ask: { device: DeviceChoice }; answer: DeviceReport };
  plan: { ask: { files: readonly StackFile[] }; answer: Plan };
  thumbnail: { ask: { file: StackFile; color: ColorMode; side: number }; answer: Thumbnail };
  estimate: {
    ask: {
      files: readonly StackFile[];
      mask: StackFile | undefined;
      lights: StackFile | undefined;
      settings: Settings;
    };
    answer: Estimate;
  };
}

/** The name of a task. */
export type TaskName = keyof Tasks;

/** To the worker: one task, or the wish to stop the one under way. */
export type ToWorker = { [T in TaskName]: { task: T; ask: Tasks[T]["ask"] } }[TaskName] | { task: "cancel" };

/** From the worker: news while a task runs, its end, or that the module is beyond repair. */
export type FromWorker =
  | { news: "load"; fraction: number }
  | { news: "progress"; stage: Stage; fraction: number }
  | { news: "done"; answer: Tasks[TaskName]["answer"] }
  | { news: "failed"; kind: "input" | "device" | "cancelled"; message: string }
  | { news: "crashed"; message: string };
