import { byId, say } from "./dom.js";
import type { Engine } from "./engine.js";
import { type Depth, type Format, knownOf, layersOf, photographId } from "./maps.js";
import { Photographs } from "./photographs.js";
import { Distrust } from "./relight/distrust.js";
import { Relighting } from "./relight/relighting.js";
import { Replay } from "./relight/replay.js";
import type { Outcome } from "./result.js";
import type { Layer } from "./viewer/choice.js";
import { Viewer } from "./viewer/viewer.js";

/** What is known of the result that is shown. */
interface Current {
  readonly outcome: Outcome;
  readonly photographs: Photographs;
  readonly distrust: Distrust;
  depth?: Depth;
}

/** The pictures of a result: the viewer, and the light in which it shows the object. */
export class Pictures {
  readonly relighting = new Relighting(byId("viewer-canvas"), () => this.#viewer.refresh());
  readonly #viewer = new Viewer(this.relighting);
  readonly #replay = new Replay(this.relighting, (index) => this.#replayed(index));
  readonly #relit: Layer = { id: "relit", name: "Relit", load: () => this.relighting.picture };
  #current: Current | undefined;
  #format: Format = "opengl";

  constructor(private readonly engine: Engine) {}

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
  }

  show(outcome: Outcome): void {
    this.#current?.distrust.close();
    const { estimate, files } = outcome;
    const { width, height, normalMap, albedo } = estimate;
    const photographs = new Photographs(this.engine, estimate, files);
    const distrust = new Distrust(estimate, photographs);
    this.#current = { outcome, photographs, distrust };
    this.relighting.show({ width, height, normals: normalMap.data, albedo });
    this.#replay.show(estimate.lights, distrust);
    this.#viewer.show(this.#layers(this.#current), estimate, knownOf(estimate, undefined), "relit");
  }

  /** The chosen lamp goes to the direction with this x and y. */
  shineFrom(x: number, y: number): void {
    this.relighting.lamps.moveTo(x, y);
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
      relit: this.#relit,
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
