import type { viewerPage as en } from "../en/viewer_page.js";

export const viewerPage: typeof en = {
  title: "Karten",
  show: "Zeigen",
  beside: "daneben",
  lamp: "Ziehen bewegt die Lampe",
  lampWhat: "Ist dies an, bewegen Ziehen und Pfeiltasten die Lampe, mit Umschalt das Bild.",
  zooms: "Größe des Bilds",
  smaller: "Kleiner",
  smallerKey: "Kleiner (−)",
  size: "Größe",
  larger: "Größer",
  largerKey: "Größer (+)",
  fit: "Einpassen",
  fitKey: "Das ganze Bild (0)",
  actualKey: "Ein Pixel der Karte je Pixel des Bildschirms (1)",
  fullScreenKey: "Vollbild (F)",
  picture: "Bild",
  map: "Karte",
  divider: "Trennlinie",
  histogram: "Histogramm",
  keys: "Mausrad, zwei Finger, + und − ändern die Größe, 0 zeigt alles, 1 einzelne Pixel; Ziehen oder Pfeiltasten bewegen das Bild oder die Lampe.",
};
