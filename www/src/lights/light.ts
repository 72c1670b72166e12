import { texts } from "../texts/texts.js";
/** A light as the hand holds it: a unit vector (x right, y up, z to the camera) and how bright it is. */
export interface HandLight {
  readonly file: string;
  readonly x: number;
  readonly y: number;
  readonly z: number;
  readonly intensity: number;
  readonly confidence: number;
}

/** A light in the direction of three numbers; nothing when they have no direction. */
export function directed(light: HandLight, x: number, y: number, z: number): HandLight | undefined {
  const length = Math.hypot(x, y, z);
  if (!Number.isFinite(length) || length < 1e-6) return undefined;
  return { ...light, x: x / length, y: y / length, z: z / length };
}

/** How far a light stands above the plane of the picture, in degrees: 90 is at the camera. */
export function elevation({ x, y, z }: HandLight): number {
  return (Math.atan2(z, Math.hypot(x, y)) * 180) / Math.PI;
}

/** From which side a light comes, in degrees, from the right over the top. */
export function azimuth({ x, y }: HandLight): number {
  return ((Math.atan2(y, x) * 180) / Math.PI + 360) % 360;
}

/** A direction in words: where the lamp stood, seen from the camera. */
export function inWords(light: HandLight): string {
  const up = Math.round(elevation(light));
  return up > 80 ? texts.directions.beside : texts.directions.above(Math.round(azimuth(light) / 45) % 8, up);
}
