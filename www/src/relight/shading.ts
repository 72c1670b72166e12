import type { Vector } from "../vector.js";
import { towards } from "../vector.js";

/** A lamp at a distance. */
export interface Lamp {
  /** Its direction, by x and y of the unit vector: right and up. */
  readonly x: number;
  readonly y: number;
  /** 1 is a lamp as bright as those of the photographs on average. */
  readonly brightness: number;
}

/** How a surface answers to light. */
export interface Look {
  /** How much light is scattered in all directions; 1 as the albedo says. */
  readonly diffuse: number;
  /** How much is reflected by Blinn and Phong's lobe. */
  readonly specular: number;
  /** How narrow that lobe is, 0..1. */
  readonly gloss: number;
  /** How many times the slopes of the surface are exaggerated. */
  readonly detail: number;
  /** Whether what bulges is shown as hollow. */
  readonly flipped: boolean;
  /** Whether the surface has its own colours, or those of clay. */
  readonly coloured: boolean;
}

/** A look for the beginning: a matt surface with a hint of gloss. */
export const PLAIN: Look = {
  diffuse: 1,
  specular: 0.06,
  gloss: 0.45,
  detail: 1,
  flipped: false,
  coloured: true,
};

/** A lamp for the beginning: from the upper left. */
export const FIRST: Lamp = { x: -0.45, y: 0.5, brightness: 1 };

/** Lamps at most: the shader has room for so many. */
export const MOST_LAMPS = 4;

/** Light where no lamp shines, so that shadows keep some form. */
export const AMBIENT = 0.015;

/** What every lamp is multiplied by: albedo maps are brightest at white, few lamps shine straight at a surface. */
export const EXPOSURE = 1.15;

/** The reflectance of clay. */
export const CLAY = 0.62;

/** The exponent of Blinn and Phong's lobe: 2 to 1024. */
export function exponentOf(gloss: number): number {
  return 2 ** (1 + 9 * gloss);
}

/** The normal with exaggerated slopes, turned inside out or not. */
export function shaped(
  [x, y, z]: Vector,
  { detail, flipped }: Pick<Look, "detail" | "flipped">,
): [number, number, number] {
  const slope = flipped ? -detail : detail;
  const length = Math.hypot(slope * x, slope * y, z) || 1;
  return [(slope * x) / length, (slope * y) / length, z / length];
}

/** The direction to a lamp, and the one half way to the camera, in one list of six numbers. */
export function anglesOf({ x, y }: Pick<Lamp, "x" | "y">): number[] {
  const [a, b, c] = towards(x, y);
  const half = Math.hypot(a, b, c + 1);
  return [a, b, c, a / half, b / half, (c + 1) / half];
}

/** Shades single points under lamps; made once for many points. */
export class Shader {
  readonly #angles: readonly number[][];
  readonly #exponent: number;

  constructor(
    private readonly lamps: readonly Lamp[],
    private readonly look: Look,
  ) {
    this.#angles = lamps.map(anglesOf);
    this.#exponent = exponentOf(look.gloss);
  }

  /** The light that comes from a point: a factor of its colour, and white on top. */
  light(x: number, y: number, z: number): [number, number] {
    const [a, b, c] = shaped([x, y, z], this.look);
    let [scattered, reflected] = [0, 0];
    for (const [index, { brightness }] of this.lamps.entries()) {
      const [lx = 0, ly = 0, lz = 0, hx = 0, hy = 0, hz = 0] = this.#angles[index] ?? [];
      const facing = a * lx + b * ly + c * lz;
      scattered += brightness * (Math.max(facing, 0) + AMBIENT);
      if (facing > 0) reflected += brightness * Math.max(a * hx + b * hy + c * hz, 0) ** this.#exponent;
    }
    return [EXPOSURE * this.look.diffuse * scattered, EXPOSURE * this.look.specular * reflected];
  }
}
