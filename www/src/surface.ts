import { context } from "./dom.js";
import { DECODED, ENCODED, STEPS } from "./relight/encoding.js";
import { AMBIENT } from "./relight/shading.js";
import type { Vector } from "./vector.js";

/** A surface that can be lit anew: normals and colours, one per pixel. */
export class Surface {
  /** Whether the surface's own colours show, or plain clay. */
  coloured = true;
  readonly #picture: ImageData;

  /**
   * @param normals `[height, width, 3]`, y up, zero outside the object
   * @param albedo `[height, width, 4]`, 8-bit sRGB
   */
  constructor(
    readonly width: number,
    readonly height: number,
    private readonly normals: Float32Array,
    private readonly albedo: Uint8Array,
  ) {
    this.#picture = new ImageData(width, height);
  }

  /** Draws the surface under a distant lamp; outside the object the canvas stays clear. */
  draw(canvas: HTMLCanvasElement, [x, y, z]: Vector, brightness = 1): void {
    const { data } = this.#picture;
    const { normals, albedo, coloured } = this;
    // Half way between lamp and camera, for a hint of gloss.
    const half = Math.hypot(x, y, z + 1);
    const [hx, hy, hz] = [x / half, y / half, (z + 1) / half];
    for (let pixel = 0, n = 0; pixel < data.length; pixel += 4, n += 3) {
      const [a, b, c] = [normals[n] ?? 0, normals[n + 1] ?? 0, normals[n + 2] ?? 0];
      if (a === 0 && b === 0 && c === 0) {
        data[pixel + 3] = 0;
        continue;
      }
      const diffuse = brightness * (Math.max(a * x + b * y + c * z, 0) + AMBIENT);
      const gloss = brightness * 0.06 * Math.max(a * hx + b * hy + c * hz, 0) ** 32;
      for (let channel = 0; channel < 3; channel++) {
        const own = coloured ? (DECODED[albedo[pixel + channel] ?? 0] ?? 0) : 0.62;
        const light = Math.min(own * diffuse + gloss, 1);
        data[pixel + channel] = ENCODED[Math.round(light * STEPS)] ?? 0;
      }
      data[pixel + 3] = 255;
    }
    context(canvas).putImageData(this.#picture, 0, 0);
  }
}
