import type { Crop, Frame } from "../../crop/rectangle.js";
import type { crop as English } from "../en/crop.js";

const pixels = ({ width, height }: Frame) => `${width} × ${height} Pixel`;
const rectangle = (crop: Crop) => `${pixels(crop)}, ${crop.left} von links und ${crop.top} von oben`;

export const crop: typeof English = {
  title: "Ausschnitt",
  done: "Fertig",
  doneTitle: "Nimmt diesen Ausschnitt aller Fotos",
  cancel: "Abbrechen",
  cancelTitle: "Lässt alles, wie es war",
  inPixels: "In Pixeln",
  numbers: { left: "Links", top: "Oben", width: "Breite", height: "Höhe" },
  whole: "Ganzes Bild",
  wholeTitle: "Nichts wird abgeschnitten",
  keys:
    "Ziehen Sie auf dem Foto, oder nehmen Sie die Pfeiltasten: Sie verschieben das Rechteck, mit Umschalt " +
    "ändern sie seine Größe, mit Strg in einzelnen Pixeln. Der Ausschnitt gilt für alle Fotos und für die Maske.",
  kind: "Rechteck",
  box: "Der Ausschnitt",
  rectangle,
  wholeFrame: (crop) => `Das ganze Bild, ${pixels(crop)}`,
  taken: (crop, { width, height }) => `Ausschnitt aller Fotos: ${rectangle(crop)}, aus ${width} × ${height}.`,
  begin: "Ausschnitt …",
  change: "Ausschnitt ändern …",
  unknown: "Noch ist nicht bekannt, welche Dateien Fotos sind.",
  fixed: (file, why) => `Die Fotos lassen sich nur ganz nehmen: ${file} ${why}.`,
};
