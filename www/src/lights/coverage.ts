import { texts } from "../texts/texts.js";
import type { HandLight } from "./light.js";

/**
 * Normals are told apart by how brightness changes from light to light. Lights within this angle of their mean shade a
 * surface nearly alike: noise then decides. 20 degrees is a lamp moved by a third of its distance.
 */
const NARROW = 20;

/**
 * The share of lights on one side from which on the other side of the object is known by a light or two only. Chance
 * gives that to one stack of 12 lights in fifty.
 */
const ONE_SIDED = 0.85;

/** The same share where no lamp at all stood opposite: the others stood above or below the middle. */
const NONE_OPPOSITE = 0.6;

/** Mean height above the picture in degrees: lower lamps graze the surface and shadows cover it. */
const GRAZING = 25;

/** Lights that are doubtful, as a share, from which on the photographs rather than a lamp are the cause. */
const MANY_DOUBTFUL = 0.3;

/** A side of the picture from which light comes. */
export type Side = "left" | "right" | "top" | "bottom";

/** What the lights of a stack say about how it was photographed: lines for people, none when all is well. */
export function coverage(lights: readonly HandLight[]): string[] {
  if (lights.length < 3) return [];
  return [spread(lights), side(lights), height(lights), doubtful(lights)].flatMap((line) => line ?? []);
}

/** Largest angle in degrees between a light and the mean of all. */
export function widest(lights: readonly HandLight[]): number {
  const mean = meanOf(lights);
  const length = Math.hypot(...mean);
  if (length < 1e-9) return 180;
  const cosines = lights.map(({ x, y, z }) => (x * mean[0] + y * mean[1] + z * mean[2]) / length);
  return (Math.acos(Math.min(Math.max(Math.min(...cosines), -1), 1)) * 180) / Math.PI;
}

function spread(lights: readonly HandLight[]): string | undefined {
  const degrees = widest(lights);
  if (degrees >= NARROW) return undefined;
  return texts.lights.narrow(Math.ceil(degrees));
}

/** A side from which hardly any light came; lights beside the camera are on no side. */
function side(lights: readonly HandLight[]): string | undefined {
  const sides = [
    ["left", ({ x }: HandLight) => -x],
    ["right", ({ x }: HandLight) => x],
    ["top", ({ y }: HandLight) => y],
    ["bottom", ({ y }: HandLight) => -y],
  ] as const;
  for (const [name, along] of sides) {
    const there = lights.filter((light) => along(light) > 0.1).length;
    const opposite = lights.filter((light) => along(light) < -0.1).length;
    if (opposite === 0 && there >= NONE_OPPOSITE * lights.length) return texts.lights.noneOpposite(name);
    if (there >= ONE_SIDED * lights.length) return texts.lights.fewOpposite(name);
  }
  return undefined;
}

function height(lights: readonly HandLight[]): string | undefined {
  const degrees =
    lights.reduce((sum, { z }) => sum + Math.asin(Math.min(Math.max(z, -1), 1)), 0) / lights.length;
  if ((degrees * 180) / Math.PI >= GRAZING) return undefined;
  return texts.lights.grazing;
}

function doubtful(lights: readonly HandLight[]): string | undefined {
  const doubtful = lights.filter(({ confidence }) => confidence < 0.45);
  if (doubtful.length < MANY_DOUBTFUL * lights.length) return undefined;
  const names = doubtful.slice(0, 4).map(({ file }) => file);
  return texts.lights.doubtful(doubtful.length, lights.length, names);
}

function meanOf(lights: readonly HandLight[]): [number, number, number] {
  const sum = (of: (light: HandLight) => number) => lights.reduce((all, light) => all + of(light), 0);
  return [sum(({ x }) => x), sum(({ y }) => y), sum(({ z }) => z)];
}
