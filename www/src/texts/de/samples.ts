import type { samples as en } from "../en/samples.js";

export const samples: typeof en = {
  title: "Mit einem Beispiel probieren",
  what: "Gerenderte Objekte, um zu sehen, wie es geht",
  cancel: "Abbrechen",
  progress: "Fortschritt des Ladens",
  fetching: (title) => `„${title}“ wird geladen`,
  words: {
    statue: { title: "Steinkatze", description: "Weiches Licht, gemeißelte Ohren und Pfoten" },
    relief: { title: "Relief", description: "Eine Figur, in eine Tafel geprägt" },
    glossy: { title: "Glasierte Vase", description: "Glanzlichter auf einem gemalten Muster" },
  },
  failed: (path, reason) => `Die Datei ${path} des Beispiels lässt sich nicht laden: ${reason}`,
  noConnection: (reason) => `keine Verbindung (${reason})`,
  webPage: "Die Antwort ist eine Webseite",
};
