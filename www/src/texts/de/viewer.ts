import type { viewer as English } from "../en/viewer.js";
import { fixed, short } from "../numbers.js";

export const viewer: typeof English = {
  nothing: "nichts",
  fetching: (map) => `${map} wird geholt`,
  failed: (map, why) => `${map} lässt sich nicht zeigen: ${why}`,
  fullScreen: "Vollbild",
  leaveFullScreen: "Vollbild verlassen",
  shown: (map, other) => (other === undefined ? `${map}.` : `${map} und ${other}, nebeneinander.`),
  divider: (left, right) => `Trennlinie zwischen ${left} und ${right}`,
  dividerAt: (percent) => `${percent} % der Breite`,
  scale: (percent) => `${percent} %`,
  histogram: (map) => `Histogramm: ${map}`,
  spread: (channel, { count, mean, lowest, highest }) =>
    count === 0
      ? `${channel}: keine Pixel`
      : `${channel} ${short(lowest)} bis ${short(highest)}, Mittel ${short(mean)}`,
  values: "Werte",
  point: "Zeigen Sie auf das Bild, um seine Werte zu lesen.",
  outside: "außerhalb des Objekts",
  pixel: "Pixel",
  normal: "Normale",
  tilt: "Neigung",
  degrees: (degrees) => `${fixed(degrees, 1)}°`,
  albedo: "Albedo",
  depth: "Tiefe",
  pixels: (depth) => `${short(depth)} px`,
  red: "Rot",
  green: "Grün",
  blue: "Blau",
};
