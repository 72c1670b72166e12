import { byId, make } from "./dom.js";
import { coverage } from "./lights/coverage.js";
import { shape } from "./lights/hemisphere.js";
import type { HandLight } from "./lights/light.js";
import { texts } from "./texts/texts.js";

/** Places of a lamp, each as degrees around and above the picture. */
type Places = readonly (readonly [number, number])[];

/** Places of which nothing is to be said, and some of which there is. */
const EXAMPLES = {
  around: [...ring(8, 40, 0, 360), ...ring(4, 65, 20, 380)],
  oneSide: ring(12, 45, 110, 250),
  besideCamera: ring(12, 78, 0, 360),
  grazing: ring(12, 12, 0, 360),
} as const;

/** Draws good and bad places of the lamp, with what the page would say of them after a run. */
export function showCaptureHelp(): void {
  const names = Object.keys(EXAMPLES) as (keyof typeof EXAMPLES)[];
  const figures = names.map((name) => {
    const places = EXAMPLES[name];
    const [problem] = coverage(places.map(lightAt));
    const words = make("span", "", problem ?? texts.capture.good);
    const mark = make("b", "", `${problem ? "✗" : "✓"} ${texts.capture[name]}`);
    const figure = make("figure", problem ? "bad" : "good", make("figcaption", "", mark, words));
    figure.prepend(picture(places));
    return figure;
  });
  byId("capture-lamps").replaceChildren(...figures);
}

/** The object from above the camera, and the lamps around it as the camera sees them. */
function picture(places: Places): SVGSVGElement {
  const drawing = shape("svg", { viewBox: "-1.15 -1.15 2.3 2.3", "aria-hidden": "true" });
  const rings = [0.5, Math.sin(Math.PI / 3), 1].map((r) => shape("circle", { class: "ring", r }));
  const lamps = places
    .map(lightAt)
    .map(({ x, y }) => shape("circle", { class: "lamp", cx: x, cy: -y, r: 0.075 }));
  drawing.append(
    ...rings,
    shape("rect", { class: "object", x: -0.16, y: -0.2, width: 0.32, height: 0.4, rx: 0.1 }),
    ...lamps,
  );
  return drawing;
}

function ring(count: number, above: number, first: number, last: number): Places {
  return Array.from(
    { length: count },
    (_, index) => [first + ((last - first) * index) / count, above] as const,
  );
}

function lightAt([around, above]: readonly [number, number]): HandLight {
  const [a, b] = [(around * Math.PI) / 180, (above * Math.PI) / 180];
  const across = Math.cos(b);
  return {
    file: "",
    x: across * Math.cos(a),
    y: across * Math.sin(a),
    z: Math.sin(b),
    intensity: 1,
    confidence: 1,
  };
}
