// Generated from the Rust types by `cargo xtask wasm`; their comments are those of the Rust types.
// Changes by hand are lost: change the Rust types.

/**
 * What becomes of a picture without lamp.
 */
export type AmbientSetting = "none" | "auto";

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
 * How normals become depth.
 */
export interface DepthSettings {
    /**
     * How the camera saw the object.
     */
    projection?: Projection;
    /**
     * What is minimised.
     */
    integration?: Integration;
}

/**
 * What was made of normals.
 */
export interface Derived {
    /**
     * Heights in pixels towards the camera, one a pixel; NaN outside the object. The mean of each connected part is zero.
     */
    depth: FloatMap;
    /**
     * Files to keep; `depth.json` is the last.
     */
    files: DerivedFile[];
    /**
     * What is known of them.
     */
    report: DerivedReport;
}

/**
 * A file that was made of normals.
 */
export interface DerivedFile {
    /**
     * File name.
     */
    name: string;
    /**
     * Content.
     */
    bytes: Uint8Array<ArrayBuffer>;
}

/**
 * What is known of derived files: `depth.json`.
 */
export interface DerivedReport {
    /**
     * What was asked for.
     */
    settings: DerivedSettings;
    /**
     * Lowest and highest height in pixels, towards the camera; the mean of each part is zero.
     */
    range: [number, number];
    /**
     * Connected parts of the mask, whose heights have nothing to do with each other.
     */
    parts: number;
    /**
     * Pixels without a normal, filled in.
     */
    missing: number;
    /**
     * Pixels whose normal is turned too far from the camera to be used, filled in.
     */
    steep: number;
    /**
     * Share of neighbouring pixels between which the surface is torn.
     */
    torn: number;
    /**
     * Pixels of height for one step of grey in `height.png`.
     */
    height_step: number | null;
    /**
     * The same in `map-height.png`.
     */
    map_height_step: number | null;
    /**
     * Curvature (1 / pixels) that is white in `map-curvature.png`.
     */
    curvature_white: number | null;
    /**
     * Every how many pixels the mesh has a vertex.
     */
    mesh_step: number | null;
}

/**
 * What to make of normals.
 */
export interface DerivedSettings {
    /**
     * How normals become depth.
     */
    depth?: DepthSettings;
    /**
     * Take off the bow of a nearly flat object first.
     */
    flatten?: boolean;
    /**
     * Heights as PNG, TIFF and EXR.
     */
    heights?: boolean;
    /**
     * A mesh in this format.
     */
    mesh?: MeshFileFormat | null;
    /**
     * About how many triangles it may have at most.
     */
    triangles?: number;
    /**
     * Maps for painting and engines: normals, albedo, height, curvature, ambient occlusion.
     */
    maps?: MapSettings | null;
    /**
     * Fade opposite edges of the maps into each other, so that they repeat without seams.
     */
    tileable?: boolean;
}

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
     * What was decided about the files, and what is doubtful.
     */
    plan: InputPlan;
    /**
     * The same in words, a line each, as the command says them.
     */
    planWords: string[];
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
     * Expected error of each normal in degrees, one a pixel, zero outside the object; not with quality `fast`.
     */
    normalErrors?: FloatMap;
    /**
     * Mean of the errors that are to be expected, in degrees.
     */
    expectedErrors: ExpectedErrors;
    /**
     * How far off the normals are, where a file among the photographs has true ones.
     */
    trueErrors?: TruthErrors;
    /**
     * The error of each normal in degrees, one a pixel, there; not a number where nothing is to be compared.
     */
    trueErrorMap?: FloatMap;
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
 * Mean errors in degrees that rendered objects had where the program was as much in doubt; `None` where nothing is known of
 * them: lights that were given, normals of a single view.
 */
export interface ExpectedErrors {
    /**
     * Of the lights' directions.
     */
    lights: number | null | undefined;
    /**
     * Of the normals.
     */
    normals: number | null | undefined;
}

/**
 * What failed: the given files or settings, nothing (the run was stopped), or the device or the networks.
 */
export type FailureKind = "input" | "cancelled" | "device";

/**
 * Tensors on their way between workers.
 */
export interface FeatureParcel {
    /**
     * What the values are.
     */
    shapes: Uint32Array<ArrayBuffer>;
    /**
     * All tensors' values, one after the other.
     */
    values: Float32Array<ArrayBuffer>;
}

/**
 * Numbers with their shape, rows from the top.
 */
export interface FloatMap {
    /**
     * Row after row, the channels of a pixel side by side.
     */
    data: Float32Array<ArrayBuffer>;
    /**
     * `[height, width, channels]`.
     */
    shape: [number, number, number];
}

/** Workers that do a part of the normal network's work. */
export interface HelperPool {
    /** How many there are to be given work. */
    readonly count: number;
    /** Gives work to one of them; nothing where it fails. */
    features(helper: number, shapes: Uint32Array, values: Float32Array): Promise<FeatureParcel | undefined>;
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
     * The picture without lamp that was subtracted.
     */
    ambient: string | undefined;
    /**
     * The true normals, which only serve to be compared with.
     */
    truth?: string | undefined;
    /**
     * By how many pixels a photograph was moved at most, where that was asked for.
     */
    aligned: number | undefined;
    /**
     * What is doubtful.
     */
    notices: Notice[];
}

/**
 * What makes a height field fit normals.
 */
export type Integration = "bilateral" | "poisson";

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
export type LeftOutReason = { kind: "mask" } | { kind: "ambient" } | { kind: "shows-no-lamp" } | { kind: "map"; word: string } | { kind: "not-listed" } | { kind: "other-size"; size: [number, number] } | { kind: "unlike-names" } | { kind: "too-dark" } | { kind: "unread-format"; format: string } | { kind: "archive" } | { kind: "link" } | { kind: "other-folder" } | { kind: "not-an-image" } | { kind: "system" };

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
    /**
     * The file that says how bright the lights are; none for directions alone.
     */
    intensities: string | undefined;
}

/**
 * How maps are painted.
 */
export interface MapSettings {
    /**
     * Which way green points.
     */
    normal_format?: NormalFormat;
    /**
     * What is painted outside the object.
     */
    outside?: Outside;
    /**
     * Add the mask as transparency.
     */
    alpha?: boolean;
    /**
     * Eight bits a channel for normals instead of sixteen.
     */
    eight_bits?: boolean;
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
 * Formats in which meshes are written.
 */
export type MeshFileFormat = "glb" | "obj" | "ply";

/**
 * By what two names were found to mean the same file, the surest first.
 */
export type NameMatch = "full" | "path-end" | "stem" | "number" | "position";

/**
 * Which way green points in an exported normal map.
 */
export type NormalFormat = "opengl" | "directx";

/**
 * Normals as pictures.
 */
export interface NormalPictures {
    /**
     * 8-bit RGBA, transparent outside the object; rows from the top.
     */
    rgba: Uint8Array<ArrayBuffer>;
    /**
     * `normals.png`, 16 bits.
     */
    png: Uint8Array<ArrayBuffer>;
}

/**
 * Something about the input that a person should know.
 */
export type Notice = { kind: "content-over-extension"; file: string; content: string; extension: string } | { kind: "decoded-by-browser"; format: string; files: string[] } | { kind: "from-archive"; archive: string; folder: string } | { kind: "one-in-each-folder" } | { kind: "pages-as-photographs"; file: string; pages: number } | { kind: "list-by-stem"; list: string } | { kind: "list-ignored"; list: string } | { kind: "several-pages"; file: string; pages: number; page: number } | { kind: "animation"; file: string } | { kind: "several-layers"; file: string; taken: string; others: string[] } | { kind: "extra-channels"; file: string; channels: number } | { kind: "infinite"; file: string; samples: number } | { kind: "not-numbers"; file: string; samples: number } | { kind: "truth-unread"; reason: string } | { kind: "orientations"; files: string[] } | { kind: "profile-not-understood"; file: string; reason: string; taken: string } | { kind: "color-unstated"; taken: string; sure: number | undefined } | { kind: "color-mixed"; said: string[] } | { kind: "looks-otherwise"; taken: string; looks: string; factor: number; sure: number } | { kind: "mask-labels"; file: string; parts: number } | { kind: "mask-soft"; file: string; share: number } | { kind: "mask-full"; file: string } | { kind: "mask-scaled"; file: string; from: [number, number]; to: [number, number] } | { kind: "mask-from-transparency"; file: string } | { kind: "mask-inverted"; file: string } | { kind: "mask-values"; file: string; values: number[]; above: number } | { kind: "mask-guessed-whole" } | { kind: "mask-guess-unsure"; certainty: number } | { kind: "nearly-identical"; files: string[] } | { kind: "black"; files: string[] } | { kind: "saturated"; files: string[]; share: number } | { kind: "overexposed"; share: number } | { kind: "lamp-hardly-moved"; difference: number } | { kind: "room-lit"; file: string } | { kind: "ambient-left-out"; file: string } | { kind: "no-ambient" } | { kind: "ambient-brighter"; file: string; share: number } | { kind: "camera-moved"; files: string[]; pixels: number } | { kind: "unlike"; files: string[] } | { kind: "lights-count-line"; file: string; said: number; found: number } | { kind: "lights-unused"; file: string; lights: number } | { kind: "lights-by-position"; file: string } | { kind: "lights-not-unit"; file: string; shortest: number; longest: number } | { kind: "lights-behind"; file: string; behind: number; of: number } | { kind: "lights-without-intensity"; file: string; found: boolean } | { kind: "lights-contradict"; file: string; axes: string | undefined } | { kind: "lights-in-plane"; degrees: number } | { kind: "lights-one-sided"; side: string; dark: number } | { kind: "lights-as-angles"; file: string; unit: string };

/**
 * The pixels of an object.
 */
export interface ObjectMask {
    /**
     * In pixels.
     */
    width: number;
    /**
     * In pixels.
     */
    height: number;
    /**
     * 255 inside, 0 outside; rows from the top.
     */
    inside: Uint8Array<ArrayBuffer>;
    /**
     * Where it came from.
     */
    source: MaskOrigin;
    /**
     * The mask's file name, or the source in words.
     */
    words: string;
}

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
export type OutputName = "normals.png" | "normals.npy" | "lights.csv" | "lights.lp" | "lights.svg" | "albedo.png" | "mask.png" | "normals-error.png" | "normals-true-error.png" | "report.json";

/**
 * What is painted outside the object.
 */
export type Outside = "flat" | "dilated";

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
    /**
     * Files that a person might miss among the images, and why they are not.
     */
    leftOut: LeftOut[];
    /**
     * What is doubtful.
     */
    notices: Notice[];
    /**
     * Both in words, a line each, as the command says them.
     */
    words: string[];
}

/**
 * How a camera projects points.
 */
export type Projection = "orthographic" | { perspective: { focal: number } };

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
     * How far off the result may be.
     */
    expected_errors?: ExpectedErrors;
    /**
     * How far off the normals are, where true ones lie beside the photographs.
     */
    true_errors?: TruthErrors | undefined;
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
     * Use only this many images, spread over the series.
     */
    images?: number | undefined;
    /**
     * Which way the axes of a light file point: `x-right,y-up,z-out` (ours), `x-right,y-down,z-in`, ...
     */
    lightAxes?: string;
    /**
     * Lay photographs that a moved camera took over the others.
     */
    align?: boolean;
    /**
     * What becomes of a picture without lamp.
     */
    ambient?: AmbientSetting;
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
 * How far normals are from true ones, over the pixels of the object where these are known.
 */
export interface TruthErrors {
    /**
     * The file of the true normals.
     */
    file: string;
    /**
     * Mean angle in degrees.
     */
    mean: number;
    /**
     * Median angle in degrees.
     */
    median: number;
    /**
     * Share (0..1) of pixels under 11.25, 22.5 and 30 degrees.
     */
    shares: [number, number, number];
    /**
     * Number of pixels compared.
     */
    pixels: number;
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
