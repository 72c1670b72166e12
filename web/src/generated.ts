// Generated from the Rust types by `cargo xtask wasm`; their comments are those of the Rust types.
// Changes by hand are lost: change the Rust types.

/**
 * How the samples of photographs are taken to relate to light.
 */
export type ColorMode = "auto" | "linear" | "srgb";

/**
 * How class probabilities become numbers.
 */
export type Decoding = "argmax" | "soft-argmax";

/**
 * What an estimation gives.
 */
export interface Estimate {
    /**
     * In pixels.
     */
    width: number;
    /**
     * In pixels.
     */
    height: number;
    /**
     * One per image used, in order.
     */
    lights: Light[];
    /**
     * Which pixels were taken for the object, and how many.
     */
    mask: MaskReport;
    /**
     * What computed.
     */
    device: string;
    /**
     * Over how many views it was averaged.
     */
    quality: Quality;
    /**
     * Time of each stage, in the order they ran.
     */
    seconds: StageSeconds[];
    /**
     * Unit normals: x right, y up, z to the camera; zero outside the object.
     */
    normalMap: FloatMap;
    /**
     * Linear RGB up to one scale; zero outside the object.
     */
    albedoMap: FloatMap;
    /**
     * The normals as 8-bit RGBA, transparent outside the object; rows from the top.
     */
    normals: Uint8Array<ArrayBuffer>;
    /**
     * The albedo as 8-bit sRGB with alpha; rows from the top.
     */
    albedo: Uint8Array<ArrayBuffer>;
    /**
     * Files to keep.
     */
    files: OutputFile[];
}

/**
 * What failed: the given files or settings, nothing (the run was stopped), or the device or the networks.
 */
export type FailureKind = "input" | "cancelled" | "device";

/**
 * Numbers with their shape, rows from the top.
 */
export interface FloatMap {
    /**
     * Row after row, three numbers a pixel.
     */
    data: Float32Array<ArrayBuffer>;
    /**
     * `[height, width, 3]`.
     */
    shape: [number, number, number];
}

/**
 * The light of one photograph: a unit vector from the object to the light, x right, y up, z to the camera.
 */
export interface Light {
    /**
     * The photograph's file name.
     */
    file: string;
    x: number;
    y: number;
    z: number;
    /**
     * Brightness relative to the mean of the stack.
     */
    intensity: number;
    /**
     * 0 (no idea) to 1 (certain).
     */
    confidence: number;
}

/**
 * Where a mask came from: a file, transparency, a guess by brightness, or nowhere: the whole frame.
 */
export type MaskOrigin = "file" | "alpha" | "guessed" | "none";

/**
 * Which pixels were taken for the object.
 */
export interface MaskReport {
    /**
     * Where the mask came from.
     */
    source: MaskOrigin;
    /**
     * The mask's file name, or the source in words.
     */
    words: string;
    /**
     * How many pixels it has.
     */
    pixels: number;
}

/**
 * Which pixels belong to the object, where no file says so.
 */
export type MaskSetting = "auto" | "none";

/**
 * Which way green points in an exported normal map.
 */
export type NormalFormat = "opengl" | "directx";

/**
 * A file to keep.
 */
export interface OutputFile {
    /**
     * File name.
     */
    name: OutputName;
    /**
     * Content.
     */
    bytes: Uint8Array<ArrayBuffer>;
}

/**
 * Names of the files that an estimation leaves.
 */
export type OutputName = "normals.png" | "normals.npy" | "lights.csv" | "lights.lp" | "lights.svg" | "albedo.png" | "mask.png" | "report.json";

/**
 * Which of some files are the photographs, and which is the mask.
 */
export interface Plan {
    /**
     * Positions of the images among the files, in the order of the stack.
     */
    images: number[];
    /**
     * Position of the mask among the files.
     */
    mask?: number;
}

/**
 * Over how many views of the photographs an estimate is averaged.
 *
 * A view is turned or mirrored, and the world with it, so the truth is the same in all of them; the
 * networks err a little differently in each.
 */
export type Quality = "fast" | "default" | "best";

/**
 * Everything that is needed to tell later how a result came to be: `report.json`.
 */
export interface Report {
    /**
     * Version of the program.
     */
    version: string;
    /**
     * File names of the images used, in order.
     */
    inputs: string[];
    /**
     * Width of the images in pixels.
     */
    width: number;
    /**
     * Height of the images in pixels.
     */
    height: number;
    /**
     * Where the mask came from, in words.
     */
    mask: string;
    /**
     * How samples were taken.
     */
    color: ColorMode;
    /**
     * Where the lights came from, in words.
     */
    lights_from: string;
    /**
     * What computed the result.
     */
    device: string;
    /**
     * Which weights were used.
     */
    weights: WeightHashes;
    /**
     * What was asked for.
     */
    settings: ReportSettings;
    /**
     * Time of each stage, in the order they ran.
     */
    seconds: StageSeconds[];
}

/**
 * What was asked for, in the words of the command line.
 */
export interface ReportSettings {
    /**
     * The device: `auto`, `cpu`, ...
     */
    device: string;
    /**
     * Over how many views to average.
     */
    quality: Quality;
    /**
     * How light classes become numbers.
     */
    decoding: Decoding;
    /**
     * Whether lights are refitted to the normals: never those that were given.
     */
    refit: boolean;
    /**
     * `auto`, `none` (the whole frame) or the mask's file.
     */
    mask: string;
    /**
     * The file of lights that were given.
     */
    lights: string | null;
    /**
     * Most photographs to use.
     */
    images: number | null;
    /**
     * Which way green points in `normals.png`.
     */
    normal_format: NormalFormat;
    /**
     * How samples relate to light.
     */
    color: ColorMode;
}

/**
 * How to estimate; everything may be left out.
 */
export interface Settings {
    /**
     * How samples relate to light.
     */
    color?: ColorMode;
    /**
     * Which pixels belong to the object, where no file says so.
     */
    mask?: MaskSetting;
    /**
     * Use only this many images, evenly spaced.
     */
    images?: number | undefined;
    /**
     * Which way green points in `normals.png` and the preview.
     */
    normalFormat?: NormalFormat;
    /**
     * Refit the lights to the normals, and the normals to them.
     */
    refit?: boolean;
    /**
     * Over how many views of the photographs lights and normals are averaged.
     */
    quality?: Quality;
}

/**
 * A stage of a run.
 */
export type Stage = "reading" | "lights" | "normals" | "refit" | "final normals" | "albedo";

/**
 * How long one stage took.
 */
export interface StageSeconds {
    /**
     * Name of the stage.
     */
    stage: Stage;
    /**
     * Wall time in seconds.
     */
    seconds: number;
}

/**
 * What the module throws.
 */
export interface Thrown {
    kind: FailureKind;
    /**
     * In a sentence, with the file.
     */
    message: string;
}

/**
 * A photograph in few pixels.
 */
export interface Thumbnail {
    /**
     * In pixels.
     */
    width: number;
    /**
     * In pixels.
     */
    height: number;
    /**
     * 8-bit sRGB with full alpha; rows from the top.
     */
    rgba: Uint8Array<ArrayBuffer>;
}

/**
 * Hashes of the weights files, `None` for a network that was not used.
 */
export interface WeightHashes {
    /**
     * The light network.
     */
    light: string | null;
    /**
     * The normal network.
     */
    normal: string | null;
}
