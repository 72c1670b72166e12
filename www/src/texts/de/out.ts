import type { out as English } from "../en/out.js";

export const out: typeof English = {
  tooLarge: "Ein Archiv mit allem wäre größer als 4 GB: Laden Sie die Ergebnisse einzeln herunter.",
  noPicture: "Dieser Browser kann das Bild nicht schreiben.",
  page: {
    untitled: "Objekt unter einer Lampe",
    kind: "Bild",
    object: "Das Objekt unter einer Lampe",
    how: "Bewegen Sie die Lampe: mit Maus, Finger oder Pfeiltasten.",
    surface: "Die Oberfläche",
    gloss: "Glanz",
    detail: "Details",
    colours: "Farben",
    unreadable: "Dieser Browser kann die Bilder in dieser Datei nicht lesen.",
  },
};
