import type { Estimate, Light } from "normalight";
import { byId, make, sayLines } from "./dom.js";
import { showDownloads } from "./downloads.js";
import type { Engine } from "./engine.js";
import type { Format } from "./maps.js";
import { Pictures } from "./pictures.js";
import { total } from "./run.js";

/** What a run was made of and gave. */
export interface Outcome {
  readonly estimate: Estimate;
  /** The files of the stack as they were then. */
  readonly files: readonly File[];
  /** What people call that stack. */
  readonly name: string;
}

/** Shows what an estimation gave. */
export class ResultView {
  readonly #pictures: Pictures;

  constructor(engine: Engine) {
    this.#pictures = new Pictures(engine);
  }

  /** The way green points has been changed. */
  set format(format: Format) {
    this.#pictures.format = format;
  }

  show(outcome: Outcome): void {
    const { estimate } = outcome;
    byId("result").hidden = false;
    this.#pictures.show(outcome);
    showLightMap(estimate);
    this.#showLights(estimate.lights);
    showFacts(estimate);
    sayLines(byId("plan"), estimate.planWords);
    showSeconds(estimate);
    showDownloads(estimate);
    byId("result-title").focus({ preventScroll: true });
    const { top } = byId("result").getBoundingClientRect();
    const behavior = matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth";
    if (top < 0 || top > innerHeight * 0.6) byId("result").scrollIntoView({ behavior });
  }

  /** One row for each light; the row under the pointer lends its light to the relit picture. */
  #showLights(lights: readonly Light[]): void {
    const most = Math.max(...lights.map(({ intensity }) => intensity));
    const rows = lights.map((light) => {
      const { file, x, y, z, intensity, confidence } = light;
      const row = make(
        "tr",
        "",
        make("th", "", file),
        ...[x, y, z].map((value) => make("td", "number", signed(value))),
        make("td", "", bar(intensity / most, intensity.toFixed(2))),
        make("td", "", bar(confidence, `${Math.round(100 * confidence)} %`)),
      );
      row.addEventListener("pointerenter", () => this.#pictures.shineFrom(x, y));
      return row;
    });
    byId("lights").replaceChildren(...rows);
  }
}

function showLightMap({ files }: Estimate): void {
  const file = files.find(({ name }) => name === "lights.svg");
  const text = new TextDecoder().decode(file?.bytes);
  const { documentElement } = new DOMParser().parseFromString(text, "image/svg+xml");
  documentElement.setAttribute("role", "img");
  documentElement.setAttribute("aria-label", "Light map: the direction and intensity of every light");
  byId("light-map").replaceChildren(document.importNode(documentElement, true));
}

function showFacts(estimate: Estimate): void {
  const { width, height, lights, mask, device, quality } = estimate;
  const facts: [string, string][] = [
    ["Photographs", `${lights.length} of ${width} × ${height} pixels`],
    ["Mask", `${mask.words}, ${mask.pixels.toLocaleString("en")} pixels`],
    ["Device", device],
    ["Quality", quality],
    ["Time", `${total(estimate).toFixed(2)} s`],
  ];
  byId("facts").replaceChildren(
    ...facts.map(([name, value]) => make("div", "", make("dt", "", name), make("dd", "", value))),
  );
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
    list.append(make("li", "", make("i", `stage-${index}`), `${stage} `, make("b", "", seconds.toFixed(2))));
  }
  byId("seconds").replaceChildren(strip, list);
}

function bar(share: number, words: string): HTMLElement {
  const whole = make("span", "bar", words);
  whole.style.setProperty("--share", `${Math.round(100 * Math.min(Math.max(share, 0), 1))}%`);
  return whole;
}

function signed(value: number): string {
  return value.toFixed(3).replace("-", "−");
}
