import type { intro as en } from "../en/intro.js";

export const intro: typeof en = {
  title: "Die Form einer Oberfläche, aus nichts als einer bewegten Lampe",
  photographs: "Fotos",
  photographsWhat: "eines einzigen Objekts. Nur die Lampe bewegt sich, und niemand notiert, wo sie war.",
  lights: "Lichter.",
  lightsWhat: "Ein neuronales Netz findet Richtung und Helligkeit jeder Lampe.",
  normals: "Normalen.",
  normalsWhat: "Ein zweites findet in jedem Pixel, wohin die Oberfläche zeigt.",
  promise: "Alles wird auf diesem Computer berechnet. Ihre Fotos verlassen ihn nie.",
};
