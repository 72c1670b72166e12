import type { lightsPage as en } from "../en/lights_page.js";

export const lightsPage: typeof en = {
  title: "Lichter",
  estimate: "Schätzen",
  rig: "Rig",
  rigWhat: "Lichter eines Ergebnisses, die für das nächste Objekt aufgehoben wurden",
  file: "Lichtdatei",
  rigName: "Name des gewählten Rigs",
  rigDelete: "Löschen",
  mapWhat:
    "von der Kamera aus; die Farbe ist die Helligkeit, die Größe die Sicherheit; zum Korrigieren ziehen",
  table: "Jedes Licht",
  photograph: "Foto",
  x: "x",
  y: "y",
  z: "z",
  intensity: "Helligkeit",
  confidence: "Sicherheit",
};
