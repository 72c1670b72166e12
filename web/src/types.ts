import type {
  ColorMode,
  FloatMap,
  Estimate as Found,
  InputPlan,
  MeshFileFormat,
  NormalFormat,
  Outside,
  Quality,
  Stage,
} from "./generated.js";

// What crosses into the module and back has one definition, in Rust; here is what only TypeScript knows.
export type {
  ColorDecision,
  ColorMode,
  ColorReason,
  Decoding,
  DepthSettings,
  Derived,
  DerivedFile,
  DerivedReport,
  DerivedSettings,
  ExpectedErrors,
  FloatMap,
  InputPlan,
  Integration,
  LeftOut,
  LeftOutReason,
  Light,
  LightsDecision,
  MapSettings,
  MaskOrigin,
  MaskReport,
  MeshFileFormat,
  NameMatch,
  NormalFormat,
  NormalPictures,
  Notice,
  ObjectMask,
  Order,
  OutputFile,
  OutputName,
  Outside,
  Plan,
  Projection,
  Quality,
  Report,
  ReportSettings,
  Stage,
  StageSeconds,
  Thumbnail,
  TruthErrors,
  WeightHashes,
} from "./generated.js";

/** What was found in photographs. */
export interface Estimate extends Found {
  /** How many threads computed it: fewer than there might be where no workers could be started. One beside a GPU. */
  readonly threads: number;
}

/** A file of the user (from an input or a drop), or one in memory. */
export type StackFile = File | NamedFile;

/** A file in memory. */
export interface NamedFile {
  /** File name; folders before it only appear in messages. */
  readonly name: string;
  /** Content. */
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Samples in memory, row after row from the top; `ImageData` is one of them. */
export interface RawImage {
  /** `width * height * channels` samples, those of a pixel side by side. Floats are 1 where a photograph is white. */
  readonly data: Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array;
  /** In pixels. */
  readonly width: number;
  /** In pixels. */
  readonly height: number;
  /**
   * 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha (floats: 1 or 3); as many as the samples make when left out.
   * Transparency is taken for the mask where there is no other.
   */
  readonly channels?: number;
  /**
   * How the samples relate to light: encoded for viewing, or in proportion to it. When left out, 8 bits are `srgb`, 16 bits
   * and floats `linear`.
   */
  readonly colorSpace?: "srgb" | "linear" | "display-p3";
}

/** What a canvas can draw: its pixels are taken as 8 bits sRGB, when they are handed over. */
export type DrawableSource =
  | HTMLImageElement
  | HTMLCanvasElement
  | HTMLVideoElement
  | OffscreenCanvas
  | ImageBitmap
  | VideoFrame;

/**
 * An image, or a file beside the photographs: a file by name, an encoded file without one (its content says what it is),
 * samples, or what a canvas can draw. Memory that was handed over must not be changed until the call ends.
 */
export type ImageSource = StackFile | Blob | ArrayBuffer | ArrayBufferView | RawImage | DrawableSource;

/** Known lights: a file of them, its text, or a vector `[x, y, z]` (x right, y up, z to the camera) for each photograph. */
export type LightsSource =
  | StackFile
  | Blob
  | ArrayBuffer
  | ArrayBufferView
  | string
  | readonly (readonly [number, number, number])[];

/** What archives among some files hold. */
export interface UnpackedArchives {
  /** The files beside the archives, and those of the captures in them, named by their paths there. */
  readonly files: readonly File[];
  /** The names of the archives. */
  readonly archives: readonly string[];
}

/**
 * What shall compute: `auto` takes a real GPU and never one that is imitated in software, `gpu` takes what
 * WebGPU has to offer, `cpu` is the processor. Where WebGPU does not start, the processor steps in.
 */
export type DeviceChoice = "auto" | "gpu" | "cpu";

/** What computes. */
export interface DeviceReport {
  readonly kind: "gpu" | "cpu";
  /** A name for people and for `report.json`. */
  readonly name: string;
  /** Why the processor computes although a GPU was asked for or hoped for, in a sentence. */
  readonly notice?: string;
}

/** The addresses of both networks' weights (safetensors). */
export interface WeightsSource<Address = string | URL> {
  readonly light: Address;
  readonly normal: Address;
}

/** How to load the estimator. */
export interface CreateOptions {
  /** `auto` when left out. */
  readonly device?: DeviceChoice;
  /** Hears how much of module and weights has arrived. The module for the GPU comes later, in the background. */
  readonly onProgress?: (progress: LoadProgress) => void;
  /**
   * The same as a fraction alone, in 0..1.
   *
   * @deprecated `onProgress` tells more
   */
  readonly onLoad?: (fraction: number) => void;
  /**
   * Where `normalight_bg.wasm` lies, if not where this package or the bundler has put it. The other files of
   * `normalight/wasm` are then looked for beside it.
   */
  readonly wasmUrl?: string | URL;
  /** Where weights of one's own lie: files of the trainer, instead of those that ship. */
  readonly weights?: WeightsSource;
  /** Hears when another device computes than `device` said: a GPU that does not start, or fails. */
  readonly onDevice?: (device: DeviceReport) => void;
  /**
   * Where `browser-worker.js` lies with all its parts, if not where this package or the bundler has put it; from another
   * server, too. Not in Node.js.
   */
  readonly workerUrl?: string | URL;
  /**
   * Whether to compute in a worker, which is so when left out. `false` computes on the calling thread, which then stands
   * still for some tenths of a second again and again: for surroundings without workers. There all estimators share one
   * module, which stays in memory after `close()` and cannot start anew after a crash.
   */
  readonly worker?: boolean;
  /**
   * How many threads estimate on the processor: workers beside the one that is there anyhow, each with a module of its own.
   * As many as the processor has, at most four, when left out; 1 starts no more. They begin with the first estimate on the
   * processor, and end with `close()`.
   */
  readonly threads?: number;
  /** Stops the loading: the promise then rejects with the signal's reason. */
  readonly signal?: AbortSignal;
}

/** How much of module and weights has arrived. */
export interface LoadProgress {
  /** In bytes, unpacked. */
  readonly bytes: number;
  /** In 0..1; 0 until the end where the server does not say how much there is. */
  readonly fraction: number;
}

/** How to estimate; everything may be left out. */
export interface EstimateOptions {
  /** How samples relate to light; `auto` when left out. */
  readonly color?: ColorMode;
  /**
   * Which pixels belong to the object: `auto` takes a mask among the files, else transparency, else a guess by
   * brightness; `none` takes the whole frame; anything else is an image that is bright inside.
   */
  readonly mask?: "auto" | "none" | ImageSource;
  /** Known lights (`lights.csv`, `.lp`, or lines of `x y z`) instead of estimated ones. */
  readonly lights?: LightsSource;
  /**
   * Which way the axes of a light file point, each right, left, up, down, out (to the camera) or in: as in
   * `x-right,y-down,z-in`; `x-right,y-up,z-out` when left out.
   */
  readonly lightAxes?: string;
  /** Lays photographs that a moved camera took over the others (shifts only), instead of refusing them. */
  readonly align?: boolean;
  /**
   * A picture without lamp: `none` leaves it out, `auto` subtracts its light from all photographs, if one is recognised by
   * its name or by what it shows.
   */
  readonly ambient?: "none" | "auto";
  /** Use only this many images, spread over the series. */
  readonly images?: number;
  /** Which way green points in `normals.png` and the preview; `opengl` (up) when left out. */
  readonly normalFormat?: NormalFormat;
  /** Refit the lights to the normals, and the normals to them; on when left out. */
  readonly refit?: boolean;
  /** What good lights and normals may cost; `default` when left out. */
  readonly quality?: Quality;
  /** Cancels: the promise then rejects with the signal's reason. */
  readonly signal?: AbortSignal;
  /**
   * Hears what was decided about the files before anything is computed: typed, and in lines for people. Lines that begin
   * with `notice:` tell what is doubtful.
   */
  readonly onPlan?: (plan: InputPlan, words: readonly string[]) => void;
  /** Hears of progress. */
  readonly onProgress?: (progress: Progress) => void;
}

/** Normals, and perhaps colours, of which more is to be made: an `Estimate`, or maps from elsewhere. */
export interface Surface {
  /** Normals `[height, width, 3]`: x right, y up, z to the camera; zero outside the object. */
  readonly normalMap: FloatMap;
  /** Linear RGB of the same size. */
  readonly albedoMap?: FloatMap;
}

/** What to make of normals; everything may be left out. The depth map is always made. */
export interface DeriveOptions {
  /** Heights as 16-bit PNG, and in pixels as TIFF and OpenEXR. */
  readonly heights?: boolean;
  /** A mesh in this format, with the colours of the albedo. */
  readonly mesh?: MeshFileFormat;
  /** About how many triangles it may have at most; a million when left out. */
  readonly triangles?: number;
  /** Maps for engines and painting: normals, albedo, height, curvature, ambient occlusion. */
  readonly maps?: boolean | MapOptions;
  /** Fades opposite edges of the maps into each other, so that they repeat without seams. */
  readonly tileable?: boolean;
  /** Takes the bow off nearly flat objects. */
  readonly flatten?: boolean;
  /** Focal length in pixels, for depth as a near camera saw it; without it the camera is far away. */
  readonly focal?: number;
  /** Cancels before the work begins; work under way is not waited for. */
  readonly signal?: AbortSignal;
}

/** How maps are painted; everything may be left out. */
export interface MapOptions {
  /** Which way green points; `opengl` (up) when left out. */
  readonly normalFormat?: NormalFormat;
  /** Outside the object: `flat` (a surface that faces the camera) or `dilated` (the nearest pixel of the object). */
  readonly outside?: Outside;
  /** Adds the mask as transparency. */
  readonly alpha?: boolean;
  /** Bits of a channel of normals; 16 when left out. */
  readonly bits?: 8 | 16;
}

/** How far a run is. */
export interface Progress {
  /** The stage under way. */
  readonly stage: Stage;
  /** Share of the stage that is done, 0..1. */
  readonly stageFraction: number;
  /** Share of the whole run that is done, 0..1; never falls. */
  readonly fraction: number;
}

/** The stages of a run in their order; with given lights or without a refit some are left out. */
export const STAGES = Object.keys({
  reading: true,
  lights: true,
  normals: true,
  refit: true,
  "final normals": true,
  albedo: true,
} satisfies Record<Stage, true>) as readonly Stage[];
