import type { derive as en } from "../en/derive.js";
import { fixed } from "../numbers.js";

export const derive: typeof en = {
  title: "Tiefe, Netz und Texturen",
  depth: "Tiefe (PNG, TIFF, EXR)",
  mesh: "Netz",
  noMesh: "keines",
  maps: "Texturen für Engines",
  flatten: "Fast flaches Objekt ebnen",
  tileable: "Kachelbare Texturen",
  make: "Erzeugen",
  making: "Die Oberfläche wird erzeugt",
  made: (seconds, pixels, parts) => {
    const apart = parts === 1 ? "" : ` Das Objekt besteht aus ${parts} Teilen, jeder mit eigener Höhe.`;
    return `Erzeugt in ${fixed(seconds, 1)} s: ${fixed(pixels, 0)} Pixel von hinten nach vorn.${apart}`;
  },
};
