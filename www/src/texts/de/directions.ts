import type { directions as English } from "../en/directions.js";

const SIDES = [
  "rechts",
  "rechts oben",
  "oben",
  "links oben",
  "links",
  "links unten",
  "unten",
  "rechts unten",
];

export const directions: typeof English = {
  left: "links",
  right: "rechts",
  beside: "neben der Kamera",
  above: (side, degrees) => `${SIDES[side]}, ${degrees}° über der Bildebene`,
  straight: "geradewegs von der Kamera",
  from: (side, degrees) => `${degrees}° neben der Kamera, von ${SIDES[side]}`,
};
