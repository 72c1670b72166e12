import type { errors as en } from "../en/errors.js";

export const errors: typeof en = {
  noDrawing: "Dieser Browser kann nicht zeichnen.",
  before: {
    input: "Mit diesen Dateien oder Einstellungen geht es nicht",
    device: "Das Gerät oder das Rechenmodul versagt",
    load: "Der Schätzer lässt sich nicht laden",
    unsupported: "In diesem Browser läuft der Schätzer nicht",
    crashed: "Ein Fehler in der Berechnung; der Schätzer startet von selbst neu",
    closed: "Der Schätzer ist beendet",
  },
};
