import type { MaskOrigin } from "normalight";
import type { result as en } from "../en/result.js";
import { fixed, percent, whole } from "../numbers.js";
import { settings } from "./settings.js";

const masks: Record<Exclude<MaskOrigin, "file">, string> = {
  alpha: "Transparenz des ersten Bilds",
  guessed: "aus den Fotos erkannt",
  none: "ganzes Bild",
};

export const result: typeof en = {
  title: "Ergebnis",
  titleOf: (name) => `Ergebnis: ${name}`,
  stale: (name) =>
    `Dies ist das Ergebnis von ${name === "" ? "den Fotos davor" : name}. Die Fotos haben sich seitdem geändert; ein neuer Lauf ersetzt es.`,
  none: "Es gibt kein Ergebnis.",
  photographs: "Fotos",
  size: (photographs, width, height, taken) =>
    `${photographs} mit ${width} × ${height} Pixeln${taken && `, ${taken}`}`,
  mask: "Maske",
  maskOf: ({ source, words, pixels }) =>
    `${source === "file" ? words : masks[source]}, ${whole(pixels)} Pixel`,
  device: "Gerät",
  deviceOf: (device, threads) => (threads > 1 ? `${device} · ${threads} Threads` : device),
  quality: "Qualität",
  qualityOf: (quality) => settings[quality],
  expected: "Zu erwartende Fehler",
  expectedLights: (degrees) => `Lichter ${fixed(degrees, 0)}°`,
  expectedNormals: (degrees) => `Normalen ${fixed(degrees, 0)}°`,
  unknown: "unbekannt",
  errors: "Fehler",
  errorsOf: ({ file, mean, median, shares }) =>
    `Normalen, gegen ${file}: ${fixed(mean, 2)}° im Mittel, ${fixed(median, 2)}° im Median, ${percent(shares[0])} % unter 11,25°`,
  time: "Zeit",
  seconds: (seconds) => `${fixed(seconds, 2)} s`,
  stageSeconds: (seconds) => fixed(seconds, 2),
  plan: "Was wofür genommen wurde",
  secondsTitle: "Sekunden je Schritt",
};
