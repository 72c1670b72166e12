import { cleared, drawScaled } from "../viewer/picture.js";
import type { Place, Size } from "../viewer/view.js";
import { decode, encode } from "./encoding.js";
import { CLAY, type Lamp, type Look, Shader } from "./shading.js";

/** A surface: three numbers of a normal and four of an 8-bit sRGB colour at every pixel. */
export interface Skin extends Size {
  readonly normals: Float32Array<ArrayBuffer>;
  readonly albedo: Uint8Array<ArrayBuffer>;
}

/** Paints a surface under lamps. */
export interface Painter {
  /** Takes away what was painted. */
  begin(): void;
  /** Paints it so that it fills a place of the canvas; only the clip needs to be painted. */
  paint(
    drawing: CanvasRenderingContext2D,
    place: Place,
    clip: Place,
    lamps: readonly Lamp[],
    look: Look,
  ): void;
}

/** Pixels that the processor shades at every move of a lamp. */
const QUICK = 200_000;
/** Pixels that it shades once the lamp rests. */
const THOROUGH = 2_000_000;
/** Milliseconds after which a lamp rests. */
const REST = 180;

/** The painter for browsers without WebGL2: in fewer pixels while a lamp moves. */
export class ProcessorPainter implements Painter {
  readonly #canvas = document.createElement("canvas");
  #painted: { lamps: readonly Lamp[]; look: Look; step: number } | undefined;
  #resting: ReturnType<typeof setTimeout> | undefined;

  /** @param refresh asks for another painting, now that the lamp rests */
  constructor(
    private readonly skin: Skin,
    private readonly refresh: () => void,
  ) {}

  paint(drawing: CanvasRenderingContext2D, place: Place, _: Place, lamps: readonly Lamp[], look: Look): void {
    const pixels = this.skin.width * this.skin.height;
    const [quick, thorough] = [QUICK, THOROUGH].map((most) => Math.ceil(Math.sqrt(pixels / most)));
    const before = this.#painted;
    const same = before?.lamps === lamps && before.look === look;
    const step = (same ? thorough : quick) ?? 1;
    if (!same || before.step !== step) {
      shade(this.#canvas, this.skin, lamps, look, step);
      this.#painted = { lamps, look, step };
    }
    clearTimeout(this.#resting);
    if (step !== thorough) this.#resting = setTimeout(this.refresh, REST);
    drawScaled(drawing, this.#canvas, place);
  }

  begin(): void {
    // It paints on the canvas of others, who clear it.
  }

  /** Ends its waiting: another result comes. */
  close(): void {
    clearTimeout(this.#resting);
  }
}

/** Shades every so many pixels of a surface. */
function shade(
  canvas: HTMLCanvasElement,
  { width, height, normals, albedo }: Skin,
  lamps: readonly Lamp[],
  look: Look,
  step: number,
): void {
  const size = { width: Math.ceil(width / step), height: Math.ceil(height / step) };
  const drawing = cleared(canvas, size);
  const picture = new ImageData(size.width, size.height);
  const shader = new Shader(lamps, look);
  let to = 0;
  for (let row = 0; row < height; row += step) {
    for (let column = 0; column < width; column += step, to += 4) {
      const pixel = row * width + column;
      const [x, y, z] = [normals[3 * pixel] ?? 0, normals[3 * pixel + 1] ?? 0, normals[3 * pixel + 2] ?? 0];
      if (x === 0 && y === 0 && z === 0) continue;
      const [scattered, reflected] = shader.light(x, y, z);
      for (let channel = 0; channel < 3; channel++) {
        const own = look.coloured ? decode(albedo[4 * pixel + channel] ?? 0) : CLAY;
        picture.data[to + channel] = encode(own * scattered + reflected);
      }
      picture.data[to + 3] = 255;
    }
  }
  drawing.putImageData(picture, 0, 0);
}
