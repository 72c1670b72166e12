import { byId } from "../dom.js";
import { texts } from "../texts/texts.js";
import { BLUE, type Channel, GREEN, type Picture, RED } from "../viewer/picture.js";
import type { LampHook } from "../viewer/viewer.js";
import { decode, encode } from "./encoding.js";
import { GlPainter } from "./gl_painter.js";
import { Lamps } from "./lamps.js";
import { type Painter, ProcessorPainter, type Skin } from "./painter.js";
import { CLAY, type Lamp, type Look, PLAIN, Shader } from "./shading.js";

/** The sliders, and how their values are said. */
const SLIDERS = {
  diffuse: texts.relight.percent,
  specular: texts.relight.percent,
  gloss: texts.relight.percent,
  detail: texts.relight.times,
} as const;

/** The object under lamps of one's own. */
export class Relighting implements LampHook {
  readonly lamps = new Lamps(() => this.#changed());
  #look: Look = PLAIN;
  #skin: Skin | undefined;
  #painter: Painter | undefined;
  #gl: GlPainter | undefined;
  /** Whether WebGL2 was asked for: where there is none, there is none later. */
  #tried = false;

  /**
   * @param above the canvas on which the object is seen
   * @param changed hears that the object looks different now
   */
  constructor(
    private readonly above: HTMLElement,
    private readonly changed: () => void,
  ) {
    for (const [name, words] of Object.entries(SLIDERS)) {
      const slider = byId<HTMLInputElement>(`look-${name}`);
      const said = byId(`look-${name}-words`);
      slider.addEventListener("input", () => this.#set({ [name]: slider.valueAsNumber }));
      slider.addEventListener("input", () => {
        said.textContent = words(slider.valueAsNumber);
      });
    }
    for (const name of ["coloured", "flipped"] as const) {
      const box = byId<HTMLInputElement>(`look-${name}`);
      box.addEventListener("change", () => this.#set({ [name]: box.checked }));
    }
    byId("look-reset").addEventListener("click", () => this.#set(PLAIN));
    this.#set(PLAIN);
  }

  get look(): Look {
    return this.#look;
  }

  /** Opens what paints, before there is a result: that takes a while. */
  prepare(): void {
    if (!this.#tried) this.#gl = GlPainter.open(this.above, () => this.#paintByProcessor());
    this.#tried = true;
  }

  /** Takes another result. */
  show(skin: Skin): void {
    this.#skin = skin;
    this.prepare();
    this.#gl?.begin();
    this.#take(this.#gl?.load(skin) ? this.#gl : new ProcessorPainter(skin, this.changed));
    byId("relight-words").textContent = this.#painter instanceof GlPainter ? "" : texts.relight.byProcessor;
  }

  get places(): readonly Lamp[] {
    return this.lamps.all;
  }

  lampTo(x: number, y: number): void {
    this.lamps.moveTo(x, y);
  }

  lampBy(right: number, up: number): void {
    this.lamps.moveBy(right, up);
  }

  /** Before the object is drawn anew, or something else in its place. */
  begin(): void {
    this.#painter?.begin();
  }

  /** The relit object, as it looks whenever it is drawn. */
  get picture(): Picture {
    const skin = this.#skin;
    if (!skin) throw new Error("there is no result");
    const channels = [texts.viewer.red, texts.viewer.green, texts.viewer.blue].map((name, index) =>
      this.#channel(skin, name, index),
    );
    return {
      width: skin.width,
      height: skin.height,
      channels,
      range: [0, 255],
      words: (pixel) => channels.map(({ at }) => at(pixel)).join(" "),
      draw: (drawing, place, clip) => this.#painter?.paint(drawing, place, clip, this.lamps.all, this.#look),
    };
  }

  #channel({ normals, albedo }: Skin, name: string, index: number): Channel {
    let shader: Shader | undefined;
    let made: readonly unknown[] = [];
    return {
      name,
      colour: [RED, GREEN, BLUE][index] ?? RED,
      at: (pixel) => {
        if (made[0] !== this.lamps.all || made[1] !== this.#look || !shader) {
          made = [this.lamps.all, this.#look];
          shader = new Shader(this.lamps.all, this.#look);
        }
        const [x = 0, y = 0, z = 0] = [normals[3 * pixel], normals[3 * pixel + 1], normals[3 * pixel + 2]];
        if (x === 0 && y === 0 && z === 0) return Number.NaN;
        const [scattered, reflected] = shader.light(x, y, z);
        const own = this.#look.coloured ? decode(albedo[4 * pixel + index] ?? 0) : CLAY;
        return encode(own * scattered + reflected);
      },
    };
  }

  /** The GPU is lost: what is seen must not be. */
  #paintByProcessor(): void {
    this.#gl = undefined;
    if (!this.#skin) return;
    this.#take(new ProcessorPainter(this.#skin, this.changed));
    this.changed();
  }

  #take(painter: Painter): void {
    if (this.#painter instanceof ProcessorPainter) this.#painter.close();
    this.#painter = painter;
  }

  #set(some: Partial<Look>): void {
    this.#look = { ...this.#look, ...some };
    for (const [name, words] of Object.entries(SLIDERS)) {
      const value = this.#look[name as keyof typeof SLIDERS];
      byId<HTMLInputElement>(`look-${name}`).valueAsNumber = value;
      byId(`look-${name}-words`).textContent = words(value);
    }
    for (const name of ["coloured", "flipped"] as const) {
      byId<HTMLInputElement>(`look-${name}`).checked = this.#look[name];
    }
    this.#changed();
  }

  #changed(): void {
    if (this.#painter) this.changed();
  }
}
