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
  if (up > 80) return "beside the camera";
  const sides = ["right", "upper right", "top", "upper left", "left", "lower left", "bottom", "lower right"];
  const side = sides[Math.round(azimuth(light) / 45) % 8];
  return `${side}, ${up}° above the picture`;
}

/** How sure a light is, in words: numbers alone say little. */
export function sureness(confidence: number): string {
  const share = `${Math.round(100 * confidence)} %`;
  if (confidence >= 0.75) return `sure, ${share}`;
  return confidence >= 0.45 ? `fairly sure, ${share}` : `doubtful, ${share}`;
}
