import type { stack as en } from "../en/stack.js";

export const stack: typeof en = {
  add: "Hinzufügen",
  clear: "Leeren",
  notes: "Was ausgelassen oder zweifelhaft ist",
  list: "Die Dateien des Satzes; Pfeiltasten bewegen, Entf entfernt",
  remove: (file) => `${file} entfernen`,
  roomLight: "Raumlicht",
  none: "Wählen Sie mindestens drei Fotos.",
  noPhotograph: "Unter diesen Dateien ist kein Foto; nötig sind drei.",
  tooFew: (photographs) =>
    `${photographs === 1 ? "Ein Foto reicht" : "Zwei Fotos reichen"} nicht: Nötig sind drei.`,
  photographs: (count) => (count === 1 ? "1 Foto" : `${count} Fotos`),
  ambient: (file) => `ohne Lampe ${file}`,
  mask: (file) => `Maske ${file}`,
  others: (count) => (count === 1 ? "1 andere Datei" : `${count} andere Dateien`),
  archives: (names) => `aus ${names.join(", ")}`,
};
