/** A direction: x right, y up, z to the camera. */
export type Vector = readonly [number, number, number];

/** The unit vector whose x and y are these, shortened to keep clear of the horizon. */
export function towards(x: number, y: number): Vector {
  const length = Math.hypot(x, y);
  const scale = length > 0.92 ? 0.92 / length : 1;
  const [a, b] = [x * scale, y * scale];
  return [a, b, Math.sqrt(1 - a * a - b * b)];
}
