import type { Place } from "../../captures.js";
import type { folders as en } from "../en/folders.js";

/** Where something was looked for; the article stands before it. */
function named({ kind, names }: Place, one: string, several: string): string {
  const what = kind === "folders" ? "Ordner" : "Archiv";
  if (names.length === 1) return `${one} ${what} ${names[0]}`;
  return `${several} ${names.length} ${kind === "folders" ? "Ordnern" : "Archiven"}`;
}

const inside = (place: Place) => named(place, "im", "in den");

export const folders: typeof en = {
  others: "Ordner mit Fotos",
  estimateAll: "Alle schätzen",
  estimateAllCount: (count) => `Alle ${count} schätzen`,
  estimateAllWhat:
    "Nacheinander, mit diesen Einstellungen. Eine Maske oder Lichter aus einer Datei gelten nur für den Satz hier darunter, ein Ausschnitt für Fotos derselben Größe.",
  folder: (name, files) => `${name} (${files} Dateien)`,
  taken: (folder) => `Übernommen: ${folder}.`,
  several: (count, place, taken) =>
    `${count} Ordner mit Fotos liegen ${inside(place)}. Übernommen: ${taken}.`,
  nested: (folder) => `Die Fotos liegen in ${folder}.`,
  oneInEach: (count) => `Die Fotos liegen in ${count} Ordnern.`,
  empty: (place) => `Es liegt nichts ${inside(place)}. Nichts wurde übernommen.`,
  noPhotographs: (place, others) =>
    `Es liegen keine Fotos ${inside(place)}, nur ${others === 1 ? "eine andere Datei" : `${others} andere Dateien`}. Nichts wurde übernommen.`,
  emptyFolder: "Der Ordner ist leer. Nichts wurde übernommen.",
  lookingIntoArchive: "Das Archiv wird durchgesehen.",
  archiveTooLarge: (place, gigabytes) =>
    `Mehr als ${gigabytes} GB liegen ${inside(place)}: Bitte zuerst entpacken.`,
  archiveUnread: (reason) => `Das Archiv lässt sich nicht entpacken: ${reason}`,
};
