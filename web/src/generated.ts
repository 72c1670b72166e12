// Generated from the Rust types by `cargo xtask wasm`; their comments are those of the Rust types.
// Changes by hand are lost: change the Rust types.

/**
 * How samples were taken to relate to light.
 */
export interface ColorDecision {
    /**
     * `linear`, `sRGB`, or what the files say of themselves.
     */
    taken: string;
    /**
     * Why.
     */
    because: ColorReason;
}

/**
 * How the samples of photographs are taken to relate to light.
 */
export type ColorMode = "auto" | "linear" | "srgb";

/**
 * Why samples were taken as they were.
 */
export type ColorReason = "asked" | "stated" | "benchmark" | "shading" | "usual";

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
 * What was decided about the files of a stack and why: for people ([`fmt::Display`]: a few lines,
 * with `{:#}` every file), for `report.json` and for the page.
 */
export interface InputPlan {
    /**
     * The photographs that were read, in order.
     */
    photographs: string[];
    /**
     * What decided about them and their order.
     */
    order: Order;
    /**
     * Files that are not among them.
     */
    left_out: LeftOut[];
    /**
     * Where the mask came from, in words or by its file name.
     */
    mask: string;
    /**
     * How samples were taken.
     */
    color: ColorDecision;
    /**
     * How given lights were matched; `None` when there were none.
     */
    lights: LightsDecision | undefined;
    /**
     * What is doubtful.
     */
    notices: Notice[];
}

/**
 * A file that is not among the photographs.
 */
export interface LeftOut {
    /**
     * The file.
     */
    file: string;
    /**
     * Why.
     */
    reason: LeftOutReason;
}

/**
 * Why a file is not among the photographs.
 */
export type LeftOutReason = { kind: "mask" } | { kind: "ambient" } | { kind: "map"; word: string } | { kind: "not-listed" } | { kind: "other-size"; size: [number, number] } | { kind: "unread-format"; format: string } | { kind: "not-an-image" } | { kind: "system" };

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
 * How given lights were matched with the photographs.
 */
export interface LightsDecision {
    /**
     * The light file.
     */
    file: string;
    /**
     * The least sure rule that matched a light.
     */
    matched: NameMatch;
}

/**
 * Where a mask came from: a file, transparency, a guess from the photographs, or nowhere: the whole frame.
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
 * By what two names were found to mean the same file, the surest first.
 */
export type NameMatch = "full" | "path-end" | "stem" | "number" | "position";

/**
 * Which way green points in an exported normal map.
 */
export type NormalFormat = "opengl" | "directx";

/**
 * Something about the input that a person should know.
 */
export type Notice = { kind: "content-over-extension"; file: string; content: string; extension: string } | { kind: "list-by-stem"; list: string } | { kind: "list-ignored"; list: string } | { kind: "odd-name"; file: string } | { kind: "several-pages"; file: string; pages: number } | { kind: "infinite"; file: string; samples: number } | { kind: "orientations"; files: string[] } | { kind: "profile-not-understood"; file: string; reason: string } | { kind: "color-unstated"; taken: string } | { kind: "looks-otherwise"; taken: string; looks: string; factor: number } | { kind: "mask-labels"; file: string; parts: number } | { kind: "mask-soft"; file: string; share: number } | { kind: "mask-full"; file: string } | { kind: "mask-scaled"; file: string; from: [number, number]; to: [number, number] } | { kind: "mask-from-transparency"; file: string } | { kind: "mask-inverted"; file: string } | { kind: "mask-values"; file: string; values: number[]; above: number } | { kind: "mask-guessed-whole" } | { kind: "mask-guess-unsure"; certainty: number } | { kind: "nearly-identical"; files: string[] } | { kind: "black"; files: string[] } | { kind: "saturated"; files: string[]; share: number } | { kind: "lights-count-line"; file: string; said: number; found: number } | { kind: "lights-unused"; file: string; lights: number } | { kind: "lights-by-position"; file: string } | { kind: "lights-not-unit"; file: string; shortest: number; longest: number } | { kind: "lights-behind"; file: string; behind: number; of: number } | { kind: "lights-as-angles"; file: string; unit: string };

/**
 * What decided about the photographs and their order.
 */
export type Order = "names" | { list: string };

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
     * What was decided about the files, and what is doubtful.
     */
    plan: InputPlan;
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
