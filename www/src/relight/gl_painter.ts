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
  #sharp: boolean | undefined;

  private constructor(
    canvas: HTMLCanvasElement,
    gl: WebGL2RenderingContext,
    program: WebGLProgram,
    private readonly skin: Skin,
  ) {
    this.#canvas = canvas;
    this.#gl = gl;
    this.#program = program;
  }

  /**
   * A painter, where the browser has WebGL2 and textures of the surface's size.
   *
   * @param above the canvas that it will be asked to paint on
   * @param lost hears when the GPU is lost
   */
  static of(skin: Skin, above: HTMLElement, lost: () => void): GlPainter | undefined {
    const canvas = document.createElement("canvas");
    canvas.setAttribute("aria-hidden", "true");
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, powerPreference: "low-power" });
    if (!gl || gl.getParameter(gl.MAX_TEXTURE_SIZE) < Math.max(skin.width, skin.height)) return undefined;
    const program = programOf(gl);
    if (!program) return undefined;
    canvas.addEventListener("webglcontextlost", lost, { once: true });
    const painter = new GlPainter(canvas, gl, program, skin);
    painter.#upload();
    if (gl.getError() !== gl.NO_ERROR) return undefined;
    above.before(canvas);
    return painter;
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
    this.#sharpen(place.width >= 4 * this.skin.width);
    gl.uniform4f(this.#at("place"), place.left, height - place.top - place.height, place.width, place.height);
    const places = lamps.flatMap(({ x, y, brightness }) => [...towards(x, y).slice(0, 2), brightness]);
    gl.uniform3fv(this.#at("lamps"), places.length > 0 ? places : [0, 0, 0]);
    gl.uniform1i(this.#at("count"), lamps.length);
    const slope = look.flipped ? -look.detail : look.detail;
    gl.uniform4f(this.#at("look"), look.diffuse, look.specular, exponentOf(look.gloss), slope);
    gl.uniform1f(this.#at("coloured"), look.coloured ? 1 : 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  close(): void {
    this.#canvas.remove();
    this.#gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  #upload(): void {
    const gl = this.#gl;
    const { width, height, normals, albedo } = this.skin;
    gl.useProgram(this.#program);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    for (const [unit, name] of ["normals", "albedo"].entries()) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
      gl.uniform1i(this.#at(name), unit);
    }
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, albedo);
    gl.activeTexture(gl.TEXTURE0);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB16F, width, height, 0, gl.RGB, gl.FLOAT, normals);
    gl.uniform1f(this.#at("encoded"), 0);
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
