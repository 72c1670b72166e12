import type { capture as en } from "../en/capture.js";

export const capture: typeof en = {
  title: "So fotografieren Sie",
  many: "Wie viele",
  manyWhat:
    "Zehn bis zwanzig, jedes mit der Lampe an einer anderen Stelle. Sechzehn sind kaum schlechter als zweiunddreißig; vier sind um zwei Drittel schlechter.",
  far: "Wie weit",
  farWhat:
    "Die Lampe fünfmal so weit entfernt, wie das Objekt groß ist, und immer etwa gleich weit; dann kommt ihr Licht überall aus einer Richtung.",
  camera: "Kamera",
  cameraWhat: "Auf einem Stativ, mit fester Belichtung, Schärfe und festem Weißabgleich, ohne Blitz.",
  room: "Raum",
  roomWhat: "Dunkel. Sonst machen Sie noch ein Foto ohne die Lampe, und geben Sie an, welches es ist.",
  around: "Rundherum, einige höher",
  oneSide: "Von einer Seite",
  besideCamera: "Neben der Kamera",
  grazing: "Streiflicht",
  good: "Jeder Teil des Objekts wird von mehreren Seiten beleuchtet.",
};
