import { fixed } from "../texts/numbers.js";
import { texts } from "../texts/texts.js";

/** The angle between a normal and the direction to the camera, in degrees. */
export function tilt(z: number): number {
  return (Math.acos(Math.min(Math.max(z, -1), 1)) * 180) / Math.PI;
}

/** A component of a direction. */
export function component(value: number): string {
  return `${value < 0 ? "−" : " "}${fixed(Math.abs(value), 3)}`;
}

/** A colour as codes, and as it is written on the web. */
export function colourWords(red: number, green: number, blue: number): string {
  const hex = [red, green, blue].map((code) => code.toString(16).padStart(2, "0")).join("");
  return `${red} ${green} ${blue} (#${hex})`;
}

/** What is known of a result at every pixel. */
export interface Known {
  readonly width: number;
  readonly height: number;
  /** Three numbers a pixel, y up; zero outside the object. */
  readonly normals: Float32Array;
  /** Linear, three numbers a pixel. */
  readonly albedo: Float32Array;
  /** One number a pixel, when there is depth. */
  readonly depth?: Float32Array | undefined;
}

/** What is known at a pixel, as pairs of a name and words; of a pixel beside the object that it is beside it. */
export function readout(known: Known, column: number, row: number): [string, string][] {
  const { width, height, normals, albedo, depth } = known;
  if (column < 0 || row < 0 || column >= width || row >= height) return [];
  const place: [string, string] = [texts.viewer.pixel, `${column}, ${row}`];
  const pixel = row * width + column;
  const [x = 0, y = 0, z = 0] = normals.subarray(3 * pixel, 3 * pixel + 3);
  if (x === 0 && y === 0 && z === 0) return [place, ["", texts.viewer.outside]];
  const [red = 0, green = 0, blue = 0] = albedo.subarray(3 * pixel, 3 * pixel + 3);
  const words: [string, string][] = [
    place,
    [texts.viewer.normal, [x, y, z].map(component).join(" ")],
    [texts.viewer.tilt, texts.viewer.degrees(tilt(z))],
    [texts.viewer.albedo, [red, green, blue].map((value) => fixed(value, 3)).join(" ")],
  ];
  const height_ = depth?.[pixel];
  if (height_ !== undefined && !Number.isNaN(height_))
    words.push([texts.viewer.depth, texts.viewer.pixels(height_)]);
  return words;
}
