import { towards } from "../vector.js";
import type { Place } from "../viewer/view.js";
import type { Painter, Skin } from "./painter.js";
import { programOf } from "./program.js";
import { exponentOf, type Lamp, type Look } from "./shading.js";

/**
 * The painter on WebGL2: it shades what is seen, at the canvas's own pixels. It has a canvas of its own below the one that
 * it is asked to paint on, which stays clear there: copying from one to the other would cost more than the shading.
 */
export class GlPainter implements Painter {
  readonly #canvas: HTMLCanvasElement;
  readonly #gl: WebGL2RenderingContext;
  readonly #program: WebGLProgram;
  readonly #uniforms = new Map<string, WebGLUniformLocation | null>();
  #width = 1;
  #sharp: boolean | undefined;

  private constructor(canvas: HTMLCanvasElement, gl: WebGL2RenderingContext, program: WebGLProgram) {
    this.#canvas = canvas;
    this.#gl = gl;
    this.#program = program;
    gl.useProgram(program);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    for (const [unit, name] of ["normals", "albedo"].entries()) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
      gl.uniform1i(this.#at(name), unit);
    }
    gl.uniform1f(this.#at("encoded"), 0);
  }

  /**
   * A painter, where the browser has WebGL2. One serves all results: browsers keep few such canvases alive.
   *
   * @param above the canvas that it will be asked to paint on
   * @param lost hears when the GPU is lost
   */
  static open(above: HTMLElement, lost: () => void): GlPainter | undefined {
    const canvas = document.createElement("canvas");
    canvas.setAttribute("aria-hidden", "true");
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, powerPreference: "low-power" });
    const program = gl ? programOf(gl) : undefined;
    if (!gl || !program) return undefined;
    canvas.addEventListener("webglcontextlost", () => {
      canvas.remove();
      lost();
    });
    above.before(canvas);
    return new GlPainter(canvas, gl, program);
  }

  /** Takes a surface; whether there is room for it. */
  load({ width, height, normals, albedo }: Skin): boolean {
    const gl = this.#gl;
    if (gl.getParameter(gl.MAX_TEXTURE_SIZE) < Math.max(width, height)) return false;
    const size = [width, height, 0] as const;
    gl.activeTexture(gl.TEXTURE1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, ...size, gl.RGBA, gl.UNSIGNED_BYTE, albedo);
    gl.activeTexture(gl.TEXTURE0);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB16F, ...size, gl.RGB, gl.FLOAT, normals);
    this.#width = width;
    return gl.getError() === gl.NO_ERROR;
  }

  begin(): void {
    this.#gl.disable(this.#gl.SCISSOR_TEST);
    this.#gl.clear(this.#gl.COLOR_BUFFER_BIT);
  }

  paint(
    drawing: CanvasRenderingContext2D,
    place: Place,
    clip: Place,
    lamps: readonly Lamp[],
    look: Look,
  ): void {
    const [gl, canvas] = [this.#gl, this.#canvas];
    const { width, height } = drawing.canvas;
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.viewport(0, 0, width, height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(clip.left, height - clip.top - clip.height, clip.width, clip.height);
    this.#sharpen(place.width >= 4 * this.#width);
    gl.uniform4f(this.#at("place"), place.left, height - place.top - place.height, place.width, place.height);
    const places = lamps.flatMap(({ x, y, brightness }) => [...towards(x, y).slice(0, 2), brightness]);
    gl.uniform3fv(this.#at("lamps"), places.length > 0 ? places : [0, 0, 0]);
    gl.uniform1i(this.#at("count"), lamps.length);
    const slope = look.flipped ? -look.detail : look.detail;
    gl.uniform4f(this.#at("look"), look.diffuse, look.specular, exponentOf(look.gloss), slope);
    gl.uniform1f(this.#at("coloured"), look.coloured ? 1 : 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** Pixels as clear squares or smoothed. */
  #sharpen(sharp: boolean): void {
    if (sharp === this.#sharp) return;
    this.#sharp = sharp;
    const gl = this.#gl;
    for (const unit of [gl.TEXTURE0, gl.TEXTURE1]) {
      gl.activeTexture(unit);
      for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
        gl.texParameteri(gl.TEXTURE_2D, side, sharp ? gl.NEAREST : gl.LINEAR);
      }
    }
  }

  #at(name: string): WebGLUniformLocation | null {
    if (!this.#uniforms.has(name)) this.#uniforms.set(name, this.#gl.getUniformLocation(this.#program, name));
    return this.#uniforms.get(name) ?? null;
  }
}
