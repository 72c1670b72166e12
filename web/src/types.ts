/** A file of the user (from an input or a drop), or one in memory. */
export type StackFile = File | NamedFile;

/** A file in memory. */
export interface NamedFile {
  /** File name; folders before it only appear in messages. */
  readonly name: string;
  /** Content. */
  readonly bytes: Uint8Array<ArrayBuffer>;
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

/** How to load the estimator. */
export interface CreateOptions {
  /** `auto` when left out. */
  readonly device?: DeviceChoice;
  /** Hears how much of the module (networks included) has arrived, in 0..1. */
  readonly onLoad?: (fraction: number) => void;
}

/** How samples relate to light: `auto` does as the files say, or else as their layout and their shading. */
export type ColorMode = "auto" | "linear" | "srgb";

/**
 * Over how many mirrored and turned views of the photographs lights and normals are averaged: `fast` takes one,
 * `default` a few, `best` all.
 */
export type Quality = "fast" | "default" | "best";

/** How to estimate; everything may be left out. */
export interface EstimateOptions {
  /** How samples relate to light; `auto` when left out. */
  readonly color?: ColorMode;
  /**
   * Which pixels belong to the object: `auto` takes a mask among the files, else transparency, else a guess by
   * brightness; `none` takes the whole frame; a file is an image that is bright inside.
   */
  readonly mask?: "auto" | "none" | StackFile;
  /** Known lights (`lights.csv`, `.lp`, or lines of `x y z`) instead of estimated ones. */
  readonly lights?: StackFile;
  /** Use only this many images, evenly spaced. */
  readonly images?: number;
  /** Which way green points in `normals.png` and the preview; `opengl` (up) when left out. */
  readonly normalFormat?: "opengl" | "directx";
  /** Refit the lights to the normals, and the normals to them; on when left out. */
  readonly refit?: boolean;
  /** What good lights and normals may cost; `default` when left out. */
  readonly quality?: Quality;
  /** Cancels: the promise then rejects with the signal's reason. */
  readonly signal?: AbortSignal;
  /** Hears of progress. */
  readonly onProgress?: (progress: Progress) => void;
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
export const STAGES = ["reading", "lights", "normals", "refit", "final normals", "albedo"] as const;

/** A stage of a run. */
export type Stage = (typeof STAGES)[number];

/** The light of one photograph. */
export interface Light {
  /** The photograph's file name. */
  readonly file: string;
  /** Unit vector from the object to the light: x right, y up, z to the camera. */
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Brightness relative to the mean of the stack. */
  readonly intensity: number;
  /** 0 (no idea) to 1 (certain). */
  readonly confidence: number;
}

/** Names of the files that an estimation makes; the command line writes the same. */
export type OutputName =
  | "normals.png"
  | "normals.npy"
  | "lights.csv"
  | "lights.lp"
  | "lights.svg"
  | "albedo.png"
  | "mask.png"
  | "report.json";

/** Numbers with their shape, rows from the top. */
export interface FloatMap {
  readonly data: Float32Array<ArrayBuffer>;
  /** `[height, width, 3]`. */
  readonly shape: readonly [number, number, number];
}

/** What an estimation gives. */
export interface Estimate {
  readonly width: number;
  readonly height: number;
  /** One per image used, in order. */
  readonly lights: readonly Light[];
  /** Which pixels were taken for the object, and how many. */
  readonly mask: {
    readonly source: "file" | "alpha" | "guessed" | "none";
    /** The mask's file name, or the source in words. */
    readonly words: string;
    readonly pixels: number;
  };
  /** What computed. */
  readonly device: string;
  /** Over how many views it was averaged. */
  readonly quality: Quality;
  /** Time of each stage, in the order they ran. */
  readonly seconds: readonly { readonly stage: Stage; readonly seconds: number }[];
  /** Unit normals: x right, y up, z to the camera; zero outside the object. */
  readonly normalMap: FloatMap;
  /** Linear RGB up to one scale; zero outside the object. */
  readonly albedoMap: FloatMap;
  /** The normals as 8-bit RGBA, transparent outside the object; rows from the top. */
  readonly normals: Uint8Array<ArrayBuffer>;
  /** The albedo as 8-bit sRGB with alpha; rows from the top. */
  readonly albedo: Uint8Array<ArrayBuffer>;
  /** Files to keep. */
  readonly files: readonly OutputFile[];
}

/** A file to keep. */
export interface OutputFile extends NamedFile {
  readonly name: OutputName;
}

/** Which of some files are the photographs, and which is the mask. */
export interface Plan {
  /** Positions of the images among the files, in the order of the stack. */
  readonly images: readonly number[];
  /** Position of the mask among the files. */
  readonly mask?: number;
}

/** A photograph in few pixels. */
export interface Thumbnail {
  readonly width: number;
  readonly height: number;
  /** 8-bit sRGB with full alpha; rows from the top. */
  readonly rgba: Uint8Array<ArrayBuffer>;
}
