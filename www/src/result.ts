import type { Estimate } from "normalight";
import { Derive } from "./derive.js";
import { byId, make, say, sayLines } from "./dom.js";
import { Downloads, fileNameOf, type Kept } from "./downloads.js";
import type { Engine } from "./engine.js";
import { type Done, total } from "./job.js";
import { takenWords } from "./large/taken.js";
import { type Format, normalColours } from "./maps.js";
import { Pictures } from "./pictures.js";
import { sameFiles } from "./stack_name.js";
import { texts } from "./texts/texts.js";

/** What a run was made of and gave. */
export interface Outcome extends Done {
  /** The files of the stack as they were then. */
  readonly files: readonly File[];
  /** What people call that stack. */
  readonly name: string;
  /** Which way green points in its files. */
  readonly format: Format;
}

/** Shows what an estimation gave. */
export class ResultView {
  readonly #pictures: Pictures;
  readonly #derive: Derive;
  readonly #downloads = new Downloads(() => this.#share());
  #outcome: Outcome | undefined;
  #format: Format = "opengl";

  constructor(private readonly engine: Engine) {
    this.#pictures = new Pictures(engine, async () => (await this.#derive.make({}))?.depth);
    this.#derive = new Derive(
      engine,
      () => this.#format,
      ({ depth, files }) => {
        this.#downloads.add(files);
        this.#pictures.depth = depth;
      },
    );
  }

  /** Which way green points in what is shown and kept; another choice counts at once. */
  async turnGreen(format: Format): Promise<void> {
    this.#format = format;
    this.#pictures.format = format;
    const outcome = this.#outcome;
    if (!outcome) return;
    const png = await this.#normals(outcome, format);
    // Another result came meanwhile, or another choice.
    if (outcome === this.#outcome && format === this.#format) this.#downloads.turn(png, format);
  }

  /** A result may come soon. */
  prepare(): void {
    this.#pictures.relighting.prepare();
  }

  show(outcome: Outcome): void {
    const { estimate, name, format } = outcome;
    this.#outcome = outcome;
    this.#format = format;
    byId("result").hidden = false;
    byId("result-title").textContent = name === "" ? texts.result.title : texts.result.titleOf(name);
    this.stackIs(outcome.files);
    this.#pictures.format = format;
    this.#pictures.show(outcome);
    this.#derive.show(estimate);
    // Said anew: the page may speak another language than it did when it was made.
    const taken = takenWords(outcome.taken);
    showFacts(estimate, taken);
    sayLines(byId("plan"), texts.plan.ofRun(estimate.plan, estimate.planWords, taken));
    showSeconds(estimate);
    this.#downloads.show(estimate.files, name);
    // In the next frame, which lays out the page anyway: finding out where things are would do that now, and once more then.
    requestAnimationFrame(() => {
      if (outcome === this.#outcome) lookAt(byId("result-title"));
    });
  }

  /** The stack holds these files now: a result of others says so. */
  stackIs(files: readonly File[]): void {
    if (!this.#outcome) return;
    const { name, files: own } = this.#outcome;
    const stale = !sameFiles(files, own);
    byId("result").classList.toggle("old", stale);
    say(byId("result-stale"), stale ? texts.result.stale(name) : "");
  }

  /** `normals.png`; as the estimate left it, where that has green the same way. */
  async #normals({ estimate, format: own }: Outcome, format: Format): Promise<Uint8Array<ArrayBuffer>> {
    const file = estimate.files.find(({ name }) => name === "normals.png");
    if (file && format === own) return file.bytes;
    return (await this.engine.with((normalight) => normalight.normalPictures(estimate, format))).png;
  }

  async #share(): Promise<Kept> {
    if (!this.#outcome) throw new Error(texts.result.none);
    const { name, estimate } = this.#outcome;
    const { width, height, normalMap, albedo } = estimate;
    const { sharePage } = await import("./out/share.js");
    const page = await sharePage(
      name,
      { width, height, normals: normalMap.data, albedo },
      normalColours(normalMap.data, "opengl"),
      this.#pictures.relighting.lamps.all,
      this.#pictures.relighting.look,
    );
    return { name: `${fileNameOf(name)}.html`, bytes: new TextEncoder().encode(page) };
  }

  /** Shows the object under a lamp in this direction. */
  shineFrom(x: number, y: number): void {
    this.#pictures.shineFrom(x, y);
  }
}

/** Gives a title the focus, and brings it into sight. */
function lookAt(title: HTMLElement): void {
  title.focus({ preventScroll: true });
  const { top } = byId("result").getBoundingClientRect();
  const behavior = matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth";
  if (top < 0 || top > innerHeight * 0.6) byId("result").scrollIntoView({ behavior });
}

/** @param taken how the page took the photographs, in words */
function showFacts(estimate: Estimate, taken: string): void {
  // Results that an older version kept do not say how many.
  const { width, height, lights, mask, device, threads = 1, quality, trueErrors } = estimate;
  const words = texts.result;
  const facts: [string, string][] = [
    [words.photographs, words.size(lights.length, width, height, taken)],
    [words.mask, words.maskOf(mask)],
    [words.device, words.deviceOf(device, threads)],
    [words.quality, words.qualityOf(quality)],
    [words.expected, errorWords(estimate)],
    ...(trueErrors ? [[words.errors, words.errorsOf(trueErrors)] as [string, string]] : []),
    [words.time, words.seconds(total(estimate))],
  ];
  byId("facts").replaceChildren(
    ...facts.map(([name, value]) => make("div", "", make("dt", "", name), make("dd", "", value))),
  );
}

/** How far off lights and normals may be, in the mean. */
function errorWords({ expectedErrors: { lights, normals } }: Estimate): string {
  const words = [
    ...(typeof lights === "number" ? [texts.result.expectedLights(lights)] : []),
    ...(typeof normals === "number" ? [texts.result.expectedNormals(normals)] : []),
  ];
  return words.join(", ") || texts.result.unknown;
}

/** The stages side by side on one bar, as long as they took, and in words below it. */
function showSeconds(estimate: Estimate): void {
  const whole = total(estimate);
  const strip = make("div", "strip");
  strip.setAttribute("aria-hidden", "true");
  const list = make("ul", "legend");
  for (const [index, { stage, seconds }] of estimate.seconds.entries()) {
    const part = make("i", `stage-${index}`);
    part.style.flexGrow = String(Math.max(seconds / whole, 0.002));
    strip.append(part);
    const time = make("b", "", texts.result.stageSeconds(seconds));
    list.append(make("li", "", make("i", `stage-${index}`), `${texts.run.stages[stage]} `, time));
  }
  byId("seconds").replaceChildren(strip, list);
}
