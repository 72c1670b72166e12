import type { ambient as en } from "../en/ambient.js";

export const ambient: typeof en = {
  label: "Ohne Lampe aufgenommen (nur Raumlicht)",
  none: "Gibt es nicht",
  auto: "Selbst erkennen",
  thisOne: "Es ist dieses",
  marked: (file) => `Das Licht in ${file} wird von den anderen Fotos abgezogen.`,
  found: (file) => `Das Licht in ${file} wird von den Fotos abgezogen.`,
  perhaps: "Zeigt eines der Fotos allein das Licht des Raums, wird es von den anderen abgezogen.",
  leftOut: (file) =>
    `Dem Namen nach ist ${file} eines; solange Sie sagen, dass es keines gibt, wird es ausgelassen.`,
};
