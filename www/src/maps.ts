import type { Estimate } from "normalight";
import type { Photographs } from "./photographs.js";
import type { Distrust, GreyMap } from "./relight/distrust.js";
import { texts } from "./texts/texts.js";
import type { Layer } from "./viewer/choice.js";
import { short } from "./viewer/histogram.js";
import { BLUE, codes, GREEN, RED, Still, type Values, WHITE } from "./viewer/picture.js";
import { greyed, quantile, ramped } from "./viewer/ramp.js";
import { colourWords, component, type Known } from "./viewer/readout.js";

/** Which way green points. */
export type Format = "opengl" | "directx";

/** Normals as 8-bit colours, clear outside the object. */
export function normalColours(normals: Float32Array, format: Format): Uint8Array<ArrayBuffer> {
  const rgba = new Uint8Array((normals.length / 3) * 4);
  const up = format === "directx" ? -1 : 1;
  for (let from = 0, to = 0; from < normals.length; from += 3, to += 4) {
    const [x = 0, y = 0, z = 0] = [normals[from], normals[from + 1], normals[from + 2]];
    if (x === 0 && y === 0 && z === 0) continue;
    rgba[to] = Math.round(127.5 * (x + 1));
    rgba[to + 1] = Math.round(127.5 * (up * y + 1));
    rgba[to + 2] = Math.round(127.5 * (z + 1));
    rgba[to + 3] = 255;
  }
  return rgba;
}

/** Depth as one list of numbers, where there is any. */
export interface Depth {
  readonly data: Float32Array;
}

/** What maps are made of. */
export interface Sources {
  readonly estimate: Estimate;
  readonly photographs: Photographs;
  readonly distrust: Distrust;
  readonly format: Format;
  readonly depth: Depth | undefined;
  /** The photograph whose residual is asked for. */
  readonly replayed: () => number;
  readonly relit: Layer;
  /** Hears how far a long computation is. */
  readonly told: (words: string) => void;
}

/** All maps of a result. */
export function layersOf(sources: Sources): Layer[] {
  const { estimate, photographs, distrust, depth, replayed, relit, told } = sources;
  const layers = [relit, normalsLayer(sources), albedoLayer(estimate)];
  if (depth) layers.push(depthLayer(estimate, depth));
  const { normalErrors, trueErrors, trueErrorMap } = estimate;
  if (normalErrors) {
    const values = normalErrors.data.map((error) => (error === 0 ? Number.NaN : error));
    layers.push(errorLayer(estimate, values, "errors", texts.maps.expectedErrors));
  }
  if (trueErrors && trueErrorMap) {
    const name = texts.maps.trueErrors(trueErrors.file);
    layers.push(errorLayer(estimate, trueErrorMap.data, "true-errors", name));
  }
  layers.push({
    id: "distrust",
    name: texts.maps.distrust,
    load: async () => {
      const words = (done: number, of: number) => told(texts.maps.comparing(done, of));
      return residualPicture(await distrust.mean(words));
    },
  });
  layers.push({
    id: "residual",
    name: texts.maps.residual,
    load: async () => residualPicture(await distrust.of(replayed())),
  });
  for (const [index, name] of photographs.names.entries()) {
    const load = async () => {
      const { width, height, rgba } = await photographs.whole(index);
      const words = (pixel: number) => colourWords(...rgbAt(rgba, pixel));
      return new Still(width, height, rgba, { channels: codes(rgba), range: [0, 255], words });
    };
    layers.push({ id: photographId(index), name, group: texts.maps.photographs, load });
  }
  return layers;
}

/** The name of a photograph's map. */
export function photographId(index: number): string {
  return `photograph-${index}`;
}

/** What can be read at every pixel. */
export function knownOf({ width, height, normalMap, albedoMap }: Estimate, depth: Depth | undefined): Known {
  return { width, height, normals: normalMap.data, albedo: albedoMap.data, depth: depth?.data };
}

function normalsLayer({ estimate, format }: Sources): Layer {
  const { width, height, normalMap } = estimate;
  const { data } = normalMap;
  const channel = (name: string, colour: string, index: number) => ({
    name,
    colour,
    at: (pixel: number) => {
      const [x, y, z] = [data[3 * pixel], data[3 * pixel + 1], data[3 * pixel + 2]];
      return x === 0 && y === 0 && z === 0 ? Number.NaN : (data[3 * pixel + index] ?? Number.NaN);
    },
  });
  const values: Values = {
    channels: [channel("x", RED, 0), channel("y", GREEN, 1), channel("z", BLUE, 2)],
    range: [-1, 1],
    words: (pixel) => [...data.subarray(3 * pixel, 3 * pixel + 3)].map(component).join(" "),
  };
  const load = () => new Still(width, height, normalColours(data, format), values);
  return { id: "normals", name: texts.maps.normals[format], load };
}

function albedoLayer({ width, height, albedo }: Estimate): Layer {
  const words = (pixel: number) => colourWords(...rgbAt(albedo, pixel));
  const values: Values = { channels: codes(albedo), range: [0, 255], words };
  return { id: "albedo", name: texts.maps.albedo, load: () => new Still(width, height, albedo, values) };
}

function depthLayer({ width, height }: Estimate, { data }: Depth): Layer {
  const range = [quantile(data, 0.002), quantile(data, 0.998)] as const;
  const values: Values = {
    channels: [{ name: texts.maps.channels.depth, colour: WHITE, at: (pixel) => data[pixel] ?? Number.NaN }],
    range,
    words: (pixel) => `${short(data[pixel] ?? Number.NaN)} px`,
  };
  const load = () => new Still(width, height, greyed(data, range), values);
  return { id: "depth", name: texts.maps.depth, load };
}

/** Errors of normals in degrees: those to be expected, by how far apart the views are that they are means of, or true ones. */
function errorLayer({ width, height }: Estimate, values: Float32Array, id: string, name: string): Layer {
  const range = [0, quantile(values, 0.998)] as const;
  const load = () =>
    new Still(width, height, ramped(values, range), {
      channels: [
        { name: texts.maps.channels.degrees, colour: WHITE, at: (pixel) => values[pixel] ?? Number.NaN },
      ],
      range,
      words: (pixel) => `${short(values[pixel] ?? Number.NaN)}°`,
    });
  return { id, name, load };
}

/** Shares of a photograph's brightness as colours: light is where a matt surface explains it badly. */
function residualPicture({ width, height, values }: GreyMap): Still {
  const range = [0, Math.max(quantile(values, 0.98), 0.05)] as const;
  const percent = (pixel: number) => 100 * (values[pixel] ?? Number.NaN);
  return new Still(width, height, ramped(values, range), {
    channels: [{ name: texts.maps.channels.difference, colour: WHITE, at: percent }],
    range: [0, 100 * range[1]],
    words: (pixel) => `${short(percent(pixel))} %`,
  });
}

function rgbAt(rgba: Uint8Array, pixel: number): [number, number, number] {
  return [rgba[4 * pixel] ?? 0, rgba[4 * pixel + 1] ?? 0, rgba[4 * pixel + 2] ?? 0];
}
