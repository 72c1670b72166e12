import type { Estimate } from "normalight";
import { byId, make, paint, sayLines } from "./dom.js";
import { showDownloads } from "./downloads.js";
import { Relight } from "./relight.js";
import { total } from "./run.js";

/** Shows what an estimation gave. */
export class ResultView {
  readonly #relight = new Relight();

  show(estimate: Estimate, normalFormat: string): void {
    const { width, height, normals, albedo } = estimate;
    byId("result").hidden = false;
    paint(byId<HTMLCanvasElement>("normals"), width, height, normals);
    paint(byId<HTMLCanvasElement>("albedo"), width, height, albedo);
    byId("normals-words").textContent = normalFormat === "directx" ? "green is down" : "green is up";
    this.#relight.show(estimate);
    showFacts(estimate);
    sayLines(byId("plan"), estimate.planWords);
    showSeconds(estimate);
    showDownloads(estimate);
    byId("result-title").focus({ preventScroll: true });
    const { top } = byId("result").getBoundingClientRect();
    const behavior = matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth";
    if (top < 0 || top > innerHeight * 0.6) byId("result").scrollIntoView({ behavior });
  }

  /** Shows the object under a lamp in this direction. */
  shineFrom(x: number, y: number): void {
    this.#relight.shineFrom(x, y);
  }
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
