import type { relight as English } from "../en/relight.js";
import { fixed, percent } from "../numbers.js";

export const relight: typeof English = {
  lamp: (number, direction) => `Lampe ${number}: ${direction}`,
  chosen: (number, of) => `Lampe ${number} von ${of}`,
  percent: (share) => `${percent(share)} %`,
  times: (factor) => `${fixed(factor, 1)} ×`,
  byProcessor:
    "Dieser Browser hat kein WebGL2 für ein Bild dieser Größe: Der Prozessor malt, gröber, solange sich eine Lampe bewegt.",
  play: "Abspielen",
  stop: "Anhalten",
  noPhotograph: "keines: eigene Lampen",
  difference: (share) =>
    `Eine matte Oberfläche weicht von diesem Foto um ${fixed(100 * share, 1)}\u00a0% seiner Helligkeit ab.`,
  failed: (why) => `Dieses Foto lässt sich nicht zeigen: ${why}`,
};
