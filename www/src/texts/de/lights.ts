import type { lights as English } from "../en/lights.js";
import { fixed, percent } from "../numbers.js";

const count = (lights: number) => (lights === 1 ? "1 Licht" : `${lights} Lichter`);
const photographs = (count: number) => (count === 1 ? "1 Foto" : `${count} Fotos`);
const sides = { left: "links", right: "rechts", top: "oben", bottom: "unten" };

const sureness = (confidence: number) => {
  if (confidence >= 0.75) return `sicher, ${percent(confidence)} %`;
  return `${confidence >= 0.45 ? "ziemlich sicher" : "zweifelhaft"}, ${percent(confidence)} %`;
};

export const lights: typeof English = {
  map: "Lichter. Pfeiltasten wählen eines, mit Umschalt verschieben sie es, Entf lässt sein Foto weg.",
  dot: (file, direction, intensity, confidence, leftOut) =>
    `${file}: ${direction}; Helligkeit ${fixed(intensity, 2)}; ${sureness(confidence)}${leftOut ? "; weggelassen" : ""}`,
  detail: (direction, confidence) => `${direction}; ${sureness(confidence)}`,
  fields: { x: "x", y: "y", z: "z", intensity: "Helligkeit" },
  use: "dieses Foto verwenden",
  leftOut: "weggelassen",
  percent: (share) => `${percent(share)} %`,
  again: "Normalen neu schätzen",
  undo: "Änderungen zurücknehmen",
  changes: (changed, leftOut) =>
    [
      ...(changed > 0 ? [`${count(changed)} geändert`] : []),
      ...(leftOut > 0 ? [`${photographs(leftOut)} weggelassen`] : []),
    ].join(", "),
  tooFew: "Mindestens drei Fotos müssen bleiben.",
  gone: "Diese Fotos sind nicht mehr da: Wählen Sie sie zuerst wieder aus.",

  narrow: (degrees) =>
    `Alle Lampen liegen höchstens ${degrees} Grad von einer Richtung entfernt: Bewegen Sie die Lampe weiter, rund um das Objekt.`,
  noneOpposite: (side) =>
    `Alle Lampen standen ${sides[side]}: Die andere Seite des Objekts liegt in jedem Foto im Schatten.`,
  fewOpposite: (side) =>
    `Fast alle Lampen standen ${sides[side]}: Nehmen Sie mehr Fotos mit der Lampe gegenüber auf.`,
  grazing:
    "Die Lampen geben Streiflicht: Schatten bedecken viel vom Objekt. Heben Sie die Lampe zur Kamera hin, auf etwa 45 Grad.",
  doubtful: (doubtful, of, names) => {
    const more = doubtful > names.length ? " und andere" : "";
    const which = `${names.join(", ")}${more}`;
    return doubtful === 1
      ? `1 von ${count(of)}n ist zweifelhaft (${which}): Sehen Sie sich das Foto an, oder lassen Sie es weg.`
      : `${doubtful} von ${count(of)}n sind zweifelhaft (${which}): Sehen Sie sich diese Fotos an, oder lassen Sie sie weg.`;
  },

  file: "Datei mit Lichtern",
  load: "Laden …",
  loadTitle: "Lichter aus einer .lp-Datei, unserer CSV- oder JSON-Datei",
  loaded: (file) => `Lichter aus ${file}: „Normalen neu schätzen“ verwendet sie.`,
  save: (format) => `${format} speichern`,
  noLights: (file) => `${file}: Darin finden sich keine Lichter.`,
  noJson: (file) => `${file}: Das ist kein vollständiges JSON.`,
  noList: (file) => `${file}: Erwartet wird eine Liste von Lichtern oder ein Objekt mit "lights".`,
  noDirection: (file, number) => `${file}: Licht ${number} hat keine Richtung (x, y, z).`,
  otherCount: (lights, shown) => `Die Datei enthält ${count(lights)}, es sind aber ${photographs(shown)}.`,

  keepRig: "Als Rig behalten",
  keepRigTitle: "Für das nächste Objekt unter denselben Lampen; bleibt in diesem Browser",
  rigPlaceholder: "Name des Rigs",
  rigName: "Name des Rigs",
  rigFirst: "Geben Sie dem Rig zuerst einen Namen.",
  rigKept: (name, lights) =>
    `Behalten: ${name}, ${count(lights)}. Beim nächsten Objekt wählen Sie es unter „Lichter“.`,
  rig: (name, lights) => `${name} (${count(lights)})`,
  rigLacking: (name, lights, shown) =>
    `Das Rig ${name} hat ${count(lights)}, es sind aber ${photographs(shown)}: Jedes braucht sein Licht.`,
  rigUnnamed: "Ein Rig braucht einen Namen.",
  rigTaken: (name) => `Ein Rig ${name} gibt es schon.`,
};
