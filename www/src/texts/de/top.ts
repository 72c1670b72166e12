import type { top as en } from "../en/top.js";

export const top: typeof en = {
  title: "Normalight",
  description:
    "Aus Fotos unter einer bewegten Lampe werden Lichter und Oberflächennormalen, direkt im Browser.",
  tagline: "Aus Fotos unter einer bewegten Lampe werden Lichter und Oberflächennormalen.",
  language: "Sprache / Language",
  languageLater:
    "Was hier liegt, lässt sich nicht über ein Neuladen hinweg aufheben: In dieser Sprache erscheint die Seite beim nächsten Öffnen.",
};
