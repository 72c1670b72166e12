import { byId, say } from "./dom.js";
import type { Engine } from "./engine.js";
import { type Depth, type Format, knownOf, layersOf, photographId } from "./maps.js";
import { Photographs } from "./photographs.js";
import { Distrust } from "./relight/distrust.js";
import { Relighting } from "./relight/relighting.js";
import { Replay } from "./relight/replay.js";
import type { Outcome } from "./result.js";
import type { Relief } from "./solid/grid.js";
import { Solid } from "./solid/solid.js";
import { texts } from "./texts/texts.js";
import type { Layer } from "./viewer/choice.js";
import { Viewer } from "./viewer/viewer.js";

/** What is known of the result that is shown. */
interface Current {
  readonly outcome: Outcome;
  readonly photographs: Photographs;
  readonly distrust: Distrust;
  depth?: Depth | undefined;
}

/** The pictures of a result: the viewer, and the light in which it shows the object. */
export class Pictures {
  readonly relighting = new Relighting(byId("viewer-canvas"), () => this.#relit());
  readonly #viewer = new Viewer(this.relighting);
  readonly #replay = new Replay(this.relighting, (index) => this.#replayed(index));
  readonly #solid = new Solid(() => this.#relief());
  readonly #relitLayer: Layer = { id: "relit", name: texts.maps.relit, load: () => this.relighting.picture };
  #current: Current | undefined;
  #format: Format = "opengl";

  /** @param makeDepth makes the depth of the shown result, where nobody has asked for it yet */
  constructor(
    private readonly engine: Engine,
    private readonly makeDepth: () => Promise<Depth | undefined>,
  ) {}

  /** Which way green points in the normals that are shown. */
  set format(format: Format) {
    if (format === this.#format) return;
    this.#format = format;
    this.#offer();
  }

  /** The depth of the shown result, once there is one. */
  set depth(depth: Depth) {
    if (!this.#current) return;
    this.#current.depth = depth;
    this.#offer();
    this.#viewer.choose("depth", this.#viewer.chosen[1]);
    this.#solid.renew();
  }

  show(outcome: Outcome): void {
    this.#current?.distrust.close();
    this.#solid.close();
    const { estimate, used } = outcome;
    const { width, height, normalMap, albedo } = estimate;
    const photographs = new Photographs(this.engine, estimate, used);
    const distrust = new Distrust(estimate, photographs);
    this.#current = { outcome, photographs, distrust };
    this.#solid.light(this.relighting.lamps.all, this.relighting.look);
    this.relighting.show({ width, height, normals: normalMap.data, albedo });
    this.#replay.show(estimate.lights, distrust);
    this.#viewer.show(this.#layers(this.#current), estimate, knownOf(estimate, undefined), "relit");
  }

  /** The chosen lamp goes to the direction with this x and y. */
  shineFrom(x: number, y: number): void {
    this.relighting.lamps.moveTo(x, y);
  }

  /** The object looks different: in the viewer and in space. */
  #relit(): void {
    this.#viewer.refresh();
    this.#solid.light(this.relighting.lamps.all, this.relighting.look);
  }

  /** The shown result as a relief; its depth is made now, if it was not before. */
  async #relief(): Promise<Relief | undefined> {
    const current = this.#current;
    if (!current) return undefined;
    current.depth ??= await this.makeDepth();
    if (!current.depth || current !== this.#current) return undefined;
    this.#offer();
    const { width, height, normalMap, albedo } = current.outcome.estimate;
    return { width, height, depth: current.depth.data, normals: normalMap.data, albedo };
  }

  #offer(): void {
    if (!this.#current) return;
    const { outcome, depth } = this.#current;
    this.#viewer.offer(this.#layers(this.#current), knownOf(outcome.estimate, depth));
  }

  #layers({ outcome, photographs, distrust, depth }: Current): Layer[] {
    return layersOf({
      estimate: outcome.estimate,
      photographs,
      distrust,
      depth,
      format: this.#format,
      replayed: () => this.#replay.index,
      relit: this.#relitLayer,
      told: (words) => say(byId("viewer-status"), words),
    });
  }

  /** A photograph stands beside the object in its light; or none any more. */
  #replayed(index: number | undefined): void {
    const residual = this.#viewer.chosen.includes("residual");
    if (index === undefined) this.#viewer.choose("relit", "");
    else if (residual) this.#offer();
    else this.#viewer.choose("relit", photographId(index));
  }
}
