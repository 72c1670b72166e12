import type { mask as English } from "../en/mask.js";
import { fixed, whole } from "../numbers.js";
import { errors } from "./errors.js";

export const mask: typeof English = {
  title: "Maske",
  noPhotographs: "Wählen Sie zuerst Fotos: Die Maske wird darauf gezeichnet.",
  noPhotograph: "Es gibt kein Foto, auf das eine Maske gezeichnet werden kann.",

  undo: "Rückgängig",
  undoTitle: "Nimmt den letzten Schritt zurück (Strg Z)",
  redo: "Wiederholen",
  redoTitle: "Führt ihn wieder aus (Strg Umschalt Z)",
  done: "Fertig",
  doneTitle: "Übernimmt diese Maske",
  cancel: "Abbrechen",
  cancelTitle: "Lässt die Maske, wie sie war",
  largerTitle: "Größer (Plustaste)",
  smallerTitle: "Kleiner (Minustaste)",
  fit: "Einpassen",
  fitTitle: "Das ganze Foto (Taste 0)",
  actualTitle: "Pixel für Pixel (Taste 1)",

  stage:
    "Foto mit der Maske. Pfeiltasten bewegen den Pinsel, die Leertaste malt oder setzt eine Ecke, Enter schließt ein Vieleck, Plus und Minus vergrößern und verkleinern.",

  tool: "Werkzeug",
  tools: {
    brush: { words: "Pinsel", title: "Malt, was zum Objekt gehört; die rechte Maustaste radiert" },
    eraser: { words: "Radierer", title: "Malt, was nicht zum Objekt gehört" },
    polygon: {
      words: "Vieleck",
      title: "Fügt hinzu, was zwischen den Ecken liegt; Enter oder ein Doppelklick schließt",
    },
    cut: { words: "Aussparen", title: "Entfernt, was zwischen den Ecken liegt" },
    move: { words: "Bewegen", title: "Bewegt das Foto; die mittlere Maustaste tut das immer" },
  },
  withKey: (title, key) => `${title} (Taste ${key})`,
  size: "Größe",
  diameter: (pixels) => `${pixels} px`,

  byBrightness: "Nach Helligkeit",
  brightness: "Helligkeit",
  percent: (percent) => `${percent} %`,
  side: "Welche Seite das Objekt ist",
  brighter: "und heller",
  darker: "und dunkler",
  take: "Übernehmen",
  takeTitle: "Nimmt alle Pixel dieser Helligkeit als Objekt",

  edge: "Rand",
  edgePixels: "Pixel, um die der Rand wandert",
  px: "px",
  grow: "Vergrößern",
  growTitle: "Schiebt den Rand nach außen",
  shrink: "Verkleinern",
  shrinkTitle: "Schiebt den Rand nach innen",
  holes: "Löcher füllen",
  holesTitle: "Nimmt ins Objekt auf, was es umschließt",

  whole: "Ganze Maske",
  file: "Maskenbild",
  automatic: "Automatisch",
  automaticTitle: "Die Maske, die sonst genommen würde",
  load: "Laden …",
  loadTitle: "Eine Maske aus einer Datei",
  invert: "Umkehren",
  invertTitle: "Vertauscht innen und außen",
  frame: "Ganzes Bild",
  frameTitle: "Alle Pixel gehören zum Objekt",
  clear: "Leeren",
  clearTitle: "Kein Pixel gehört zum Objekt",

  photograph: "Foto",
  photographUnder: "Foto unter der Maske",
  lightened: "aufgehellt",

  looking: "Das Objekt wird gesucht …",
  loading: (file) => `${file} wird geladen …`,
  loadingPhotograph: "Das Foto wird geladen …",
  working: "Einen Augenblick …",
  writing: "Die Maske wird geschrieben …",
  noAutomatic: "Hier gibt es keine automatische Maske; „Nach Helligkeit“ kommt ihr nahe.",
  inside: (pixels, width, height) => {
    const share = fixed((100 * pixels) / (width * height), 1);
    const words = pixels === 0 ? "Nichts liegt innen: Malen Sie das Objekt" : `${share} % innen`;
    return `${words}; ${whole(pixels)} von ${width} × ${height} Pixeln`;
  },
  leaving: "Noch einmal Escape verlässt den Editor ohne diese Änderungen; „Fertig“ behält sie.",

  closed: "Der Maskeneditor wurde geschlossen.",
  stopped: (why) => `Der Maskeneditor ist ausgefallen: ${why}`,
  problem: (problem) => {
    switch (problem.kind) {
      case "shape": {
        const { mask, photograph } = problem;
        return `Die Maske hat ${mask.width} × ${mask.height} Pixel, das Foto ${photograph.width} × ${photograph.height}.`;
      }
      case "canvas":
        return errors.noDrawing;
      case "other":
        return problem.words;
    }
  },
};
