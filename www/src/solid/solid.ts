import { byId, say, sayError, wordsOf } from "../dom.js";
import type { Lamp, Look } from "../relight/shading.js";
import { texts } from "../texts/texts.js";
import type { Relief } from "./grid.js";
import { heightField, stepFor } from "./height_field.js";
import type { SolidScene } from "./scene.js";

/** Vertices at most: what laptops turn without stutter. */
const VERTICES = 300_000;

/** The surface in 3D, opened when it is asked for: what draws it is fetched only then. */
export class Solid {
  readonly #button = byId<HTMLButtonElement>("solid-open");
  readonly #stage = byId("solid-stage");
  readonly #words = byId("solid-words");
  #scene: SolidScene | undefined;
  #lamps: readonly Lamp[] = [];
  #look: Look | undefined;
  /** A number that changes with the result. */
  #turn = 0;

  /** @param relief gives the surface of the result that is shown, or nothing where it cannot be made */
  constructor(private readonly relief: () => Promise<Relief | undefined>) {
    this.#button.addEventListener("click", () => {
      if (this.#scene) this.close();
      else void this.#open();
    });
  }

  /** Other lamps, or another surface. */
  light(lamps: readonly Lamp[], look: Look): void {
    this.#lamps = lamps;
    this.#look = look;
    this.#scene?.light(lamps, look);
  }

  /** Closes it: another result comes, or it has been looked at. */
  close(): void {
    this.#turn += 1;
    this.#scene?.close();
    this.#scene = undefined;
    this.#stage.replaceChildren();
    this.#stage.hidden = true;
    byId("solid-keys").hidden = true;
    this.#button.textContent = texts.solid.show;
    say(this.#words, "");
  }

  /** The depth is another one: what is shown of the one before is out of date. */
  renew(): void {
    if (!this.#scene) return;
    this.close();
    void this.#open();
  }

  async #open(): Promise<void> {
    this.#turn += 1;
    const turn = this.#turn;
    say(this.#words, texts.solid.making);
    this.#button.disabled = true;
    try {
      const [{ SolidScene }, relief] = await Promise.all([import("./scene.js"), this.relief()]);
      if (turn !== this.#turn) return;
      if (!relief) {
        say(this.#words, texts.solid.failed);
        return;
      }
      this.#stage.hidden = false;
      const field = heightField(relief, stepFor(relief.width, relief.height, VERTICES));
      this.#scene = new SolidScene(this.#canvas(), field);
      if (this.#look) this.#scene.light(this.#lamps, this.#look);
      byId("solid-keys").hidden = false;
      this.#button.textContent = texts.solid.close;
      say(this.#words, "");
    } catch (error) {
      this.close();
      if (/webgl/i.test(wordsOf(error))) say(this.#words, texts.solid.noWebgl);
      else sayError(this.#words, error);
    } finally {
      this.#button.disabled = false;
    }
  }

  /** A new canvas: one that has lost its context gets no other. */
  #canvas(): HTMLCanvasElement {
    const canvas = document.createElement("canvas");
    canvas.id = "solid-canvas";
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-roledescription", texts.solid.kind);
    canvas.setAttribute("aria-label", texts.solid.surface);
    canvas.setAttribute("aria-describedby", "solid-keys");
    this.#stage.replaceChildren(canvas);
    return canvas;
  }
}
