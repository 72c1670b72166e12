import type { Estimate } from "normalight";
import type { CropChoice } from "../crop/choice.js";
import type { Crop } from "../crop/rectangle.js";
import { byId, chosen, say } from "../dom.js";
import type { Engine } from "../engine.js";
import { total } from "../job.js";
import type { Settings } from "../settings.js";
import type { Stack } from "../stack.js";
import { texts } from "../texts/texts.js";
import { type About, aboutPhotograph } from "./about.js";
import { memoryHere, memoryOf, type Shape, Speed } from "./cost.js";
import { sideOf } from "./side.js";
import { AS_THEY_ARE, type Shrinking, type Taken } from "./taken.js";

/** Pixels from which on photographs are large. */
const LARGE = 4e6;

/** Smaller files, unless they are PNG, hold no large photographs; they are not decoded to find out. */
const SMALL = 300_000;

const SHRINKINGS: readonly Shrinking[] = [1, 2, 4];

/** What was chosen, to be taken for other photographs. */
export interface General extends Pick<Taken, "crop" | "frame"> {
  /** Nothing where nobody has chosen. */
  readonly times: Shrinking | undefined;
}

/** What a run on large photographs costs, and at which size they are taken. */
export class SizeChoice {
  readonly #box = byId("large");
  readonly #words = byId("large-words");
  readonly #why = byId("large-why");
  readonly #speed = new Speed();
  /** The photograph that is known. */
  #file: File | undefined;
  #about: About | undefined;
  /** Whether somebody has chosen the size. */
  #asked = false;

  constructor(
    private readonly form: HTMLFormElement,
    private readonly engine: Engine,
    private readonly stack: Stack,
    private readonly settings: Settings,
    private readonly crop: CropChoice,
  ) {
    this.#box.addEventListener("change", () => {
      this.#asked = true;
    });
    form.addEventListener("change", () => this.#tell());
  }

  /** How many times smaller photographs are taken. */
  get times(): Shrinking {
    return this.#box.hidden ? 1 : (Number(chosen(this.form, "size")) as Shrinking);
  }

  /** What is taken of the photographs on the bench. */
  get taken(): Taken {
    const { crop, frame = this.#about } = this.crop;
    return { times: this.times, crop, frame: frame && { width: frame.width, height: frame.height } };
  }

  /** Another part of the photographs is taken. */
  cropped(): void {
    if (!this.#asked) this.#choose();
    this.#tell();
  }

  /** What of this goes for other photographs, too. */
  get general(): General {
    const { crop, frame } = this.crop;
    return { crop, frame, times: this.#asked && !this.#box.hidden ? this.times : undefined };
  }

  /** What is taken of photographs that are not on the bench: the crop only where they are as large. */
  async takenOf(photographs: readonly File[], { crop, frame, times }: General): Promise<Taken> {
    const [file] = photographs;
    const about = file && (await aboutPhotograph(file, this.engine).catch(() => undefined));
    if (!about) return AS_THEY_ARE;
    const { width, height, fixed } = about;
    const part = !fixed && frame?.width === width && frame.height === height ? crop : undefined;
    const { images = photographs.length } = this.settings.options;
    const fits = fitting(about, part, Math.min(images, photographs.length));
    return { times: fixed ? 1 : (times ?? fits), crop: part, frame: { width, height } };
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
    this.#asked = false;
    this.#tell();
    const about = file && (await this.#ask(file));
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

  /** What a photograph is; nothing when it is small, or nobody can tell. */
  async #ask(file: File): Promise<About | undefined> {
    if (file.size < SMALL && !/\.png$/i.test(file.name)) return undefined;
    return await aboutPhotograph(file, this.engine).catch(() => undefined);
  }

  /** The largest size for which there is memory. */
  #choose(): void {
    const about = this.#about;
    if (!about) return;
    this.#radio(fitting(about, this.crop.crop, this.#count)).checked = true;
    for (const times of [2, 4] as const) this.#radio(times).disabled = about.fixed !== "";
  }

  /** Why it is this size; empty where there is nothing to be said. */
  #reason(about: About): string {
    const { large } = texts;
    const here = memoryHere();
    const lacking = memoryOf(this.#shape(about, this.times)) <= here ? "" : large.lacking(here);
    if (about.fixed) return `${texts.crop.fixed(this.#file?.name ?? "", about.fixed)} ${lacking}`.trim();
    if (lacking) return lacking;
    return memoryOf(this.#shape(about, 1)) <= here ? "" : large.noMemory(here);
  }

  #radio(times: Shrinking): HTMLInputElement {
    const radio = this.#box.querySelector<HTMLInputElement>(`input[name="size"][value="${times}"]`);
    if (radio === null) throw new Error("the page has no such size");
    return radio;
  }

  /** How many photographs a run takes. */
  get #count(): number {
    const { images = Number.POSITIVE_INFINITY } = this.settings.options;
    return Math.min(this.stack.photographs.length, images);
  }

  #shape(about: About, times: Shrinking): Shape {
    return shapeOf(about, this.crop.crop, this.#count, times);
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
    const quality = this.settings.options.quality ?? "default";
    const seconds = this.#speed.secondsOf(this.engine.kind, shape, quality);
    const measured = this.#speed.knows(this.engine.kind);
    const time = seconds === undefined ? undefined : { seconds, measured };
    const { width, height, photographs } = shape;
    const cropped = this.crop.crop !== undefined;
    this.#words.textContent = texts.large.cost(photographs, width * height, cropped, memoryOf(shape), time);
  }
}

function shapeOf(about: About, crop: Crop | undefined, photographs: number, times: Shrinking): Shape {
  const { width, height } = crop ?? about;
  const bytes = times === 1 && !crop ? about.bytes : 1;
  const { channels } = about;
  return { width: sideOf(width, times), height: sideOf(height, times), photographs, channels, bytes };
}

/** The largest size for which there is memory. */
function fitting(about: About, crop: Crop | undefined, photographs: number): Shrinking {
  if (about.fixed) return 1;
  const fits = (times: Shrinking) => memoryOf(shapeOf(about, crop, photographs, times)) <= memoryHere();
  return SHRINKINGS.find(fits) ?? 4;
}
