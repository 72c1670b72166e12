import type { FileNotices } from "../notice_words.js";

export const fileNotices: FileNotices = {
  "content-over-extension": ({ content }) => `in Wahrheit ${content}`,
  "several-pages": ({ page, pages }) => `Seite ${page} von ${pages} wird genommen`,
  animation: () => "von einer Animation wird das erste Bild genommen",
  "several-layers": ({ taken }) => `Ebene ${taken} wird genommen`,
  "extra-channels": () => "weitere Kanäle werden ausgelassen",
  infinite: () => "hat unendliche Werte",
  "not-numbers": () => "hat Werte, die keine Zahlen sind",
  orientations: () => "gedreht, wie die Kamera es notiert hat",
  "profile-not-understood": () => "das Farbprofil wird nicht verstanden",
  "nearly-identical": () => "fast gleich wie ein anderes Foto",
  black: () => "schwarz",
  saturated: () => "überbelichtet",
  "room-lit": () => "vom Raum statt von der Lampe beleuchtet",
  "ambient-brighter": () => "dunkler als das Licht des Raums",
  "camera-moved": () => "die Kamera war verschoben",
  unlike: () => "anders als die übrigen",
};
