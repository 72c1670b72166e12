import type { Estimate } from "normalight";
import { byId, chosen, say } from "../dom.js";
import type { Engine } from "../engine.js";
import { total } from "../run.js";
import type { Settings } from "../settings.js";
import type { Stack } from "../stack.js";
import { type About, aboutPhotograph } from "./about.js";
import { memoryHere, memoryOf, type Shape, Speed } from "./cost.js";
import type { Shrinking } from "./shrink.js";

/** Pixels from which on photographs are large. */
const LARGE = 4e6;

const SHRINKINGS: readonly Shrinking[] = [1, 2, 4];

/** What a run on large photographs costs, and at which size they are taken. */
export class SizeChoice {
  readonly #box = byId("large");
  readonly #words = byId("large-words");
  readonly #why = byId("large-why");
  readonly #speed = new Speed();
  /** The photograph that is known. */
  #file: File | undefined;
  #about: About | undefined;

  constructor(
    private readonly form: HTMLFormElement,
    private readonly engine: Engine,
    private readonly stack: Stack,
    private readonly settings: Settings,
  ) {
    form.addEventListener("change", () => this.#tell());
  }

  /** How many times smaller photographs are taken. */
  get times(): Shrinking {
    return this.#box.hidden ? 1 : (Number(chosen(this.form, "size")) as Shrinking);
  }

  /** Its size before, in words. */
  get whole(): string {
    return this.#about ? `${this.#about.width} × ${this.#about.height}` : "";
  }

  /** There are other files; what they are is not known yet. */
  wait(): void {
    this.#box.hidden = true;
  }

  /** It is known what the photographs are. */
  async renew(): Promise<void> {
    const [file] = this.stack.photographs;
    if (file === this.#file) {
      this.#tell();
      return;
    }
    this.#file = file;
    this.#about = undefined;
    this.#tell();
    const about = file && (await aboutPhotograph(file, this.engine).catch(() => undefined));
    if (file !== this.#file) return;
    this.#about = about;
    this.#choose();
    this.#tell();
  }

  /** A run is done: its time is known. */
  learn({ width, height, lights, quality, seconds }: Estimate): void {
    const shape = { width, height, photographs: lights.length, channels: 3, bytes: 1 };
    this.#speed.learn(this.engine.kind, shape, quality, total({ seconds }));
    this.#tell();
  }

  /** The largest size for which there is memory. */
  #choose(): void {
    const about = this.#about;
    if (!about) return;
    const fits = SHRINKINGS.find((times) => memoryOf(this.#shape(about, times)) <= memoryHere());
    this.#radio(about.fixed ? 1 : (fits ?? 4)).checked = true;
    for (const times of [2, 4] as const) this.#radio(times).disabled = about.fixed !== "";
  }

  /** Why it is this size; empty where there is nothing to be said. */
  #reason(about: About): string {
    const here = memoryWords(memoryHere());
    const fits = memoryOf(this.#shape(about, this.times)) <= memoryHere();
    const lacking = `That is more than the ${here} that a page has: the run may fail. The command has no such limit.`;
    if (about.fixed)
      return `They can only be taken whole: ${this.#file?.name ?? ""} ${about.fixed}. ${fits ? "" : lacking}`.trim();
    if (!fits) return lacking;
    const whole = memoryOf(this.#shape(about, 1)) <= memoryHere();
    return whole ? "" : `More memory than there is for a page (${here}) would be needed for the full size.`;
  }

  #radio(times: Shrinking): HTMLInputElement {
    const radio = this.#box.querySelector<HTMLInputElement>(`input[name="size"][value="${times}"]`);
    if (radio === null) throw new Error("the page has no such size");
    return radio;
  }

  #shape({ width, height, channels, bytes }: About, times: Shrinking): Shape {
    const { images = Number.POSITIVE_INFINITY } = this.settings.options;
    const photographs = Math.min(this.stack.photographs.length, images);
    const [wide, high] = [Math.round(width / times), Math.round(height / times)];
    return { width: wide, height: high, photographs, channels, bytes: times === 1 ? bytes : 1 };
  }

  #tell(): void {
    const about = this.#about;
    const large =
      about !== undefined &&
      (about.width * about.height >= LARGE || memoryOf(this.#shape(about, 1)) > memoryHere());
    this.#box.hidden = !large;
    if (!large) return;
    say(this.#why, this.#reason(about));
    const shape = this.#shape(about, this.times);
    const size = ((shape.width * shape.height) / 1e6).toFixed(1);
    const quality = this.settings.options.quality ?? "default";
    const seconds = this.#speed.secondsOf(this.engine.kind, shape, quality);
    const time =
      seconds === undefined
        ? "how long it takes here is known after the first run"
        : `${timeWords(seconds)}${this.#speed.knows(this.engine.kind) ? ", as fast as the last run was" : ", if this processor is like ours and the object fills half of the frame"}`;
    this.#words.textContent = `${shape.photographs} photographs of ${size} megapixels: about ${memoryWords(memoryOf(shape))} of memory; ${time}.`;
  }
}

function memoryWords(bytes: number): string {
  return `${(bytes / 2 ** 30).toFixed(1)} GB`;
}

function timeWords(seconds: number): string {
  if (seconds < 90) return `about ${10 * Math.ceil(seconds / 10)} s`;
  if (seconds < 5400) return `about ${Math.round(seconds / 60)} min`;
  return `about ${Math.round(seconds / 3600)} h`;
}
