import type { relightPage as en } from "../en/relight_page.js";

export const relightPage: typeof en = {
  title: "Neu beleuchten",
  reset: "Oberfläche zurücksetzen",
  lamps: "Richtungen der Lampen, von der Kamera aus",
  diffuse: "Diffus",
  specular: "Glanz",
  gloss: "Glätte",
  detail: "Details",
  detailWhat: "Wievielfach die Neigungen der Oberfläche übertrieben werden",
  lamp: "Lampe",
  add: "Lampe hinzufügen",
  remove: "Entfernen",
  albedo: "Albedo",
  hollow: "hohl statt gewölbt",
  replay: "Neben den Fotos",
  replayWhat:
    "Beleuchtet das Objekt, wie es in jedem Foto war, und zeigt beides. Wo sie sich stark unterscheiden, sind Schatten, Glanz oder falsche Normalen der Grund: Die Karte „Wo Zweifel angebracht sind“ sammelt das über alle Fotos.",
  lightOf: "Licht von",
  previous: "Zurück",
  next: "Weiter",
};
