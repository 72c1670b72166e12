import type { large as en } from "../en/large.js";
import { fixed } from "../numbers.js";
import { crop as rectangles } from "./crop.js";

function memory(bytes: number): string {
  return `${fixed(bytes / 2 ** 30, 1)} GB`;
}

function duration(seconds: number): string {
  if (seconds < 90) return `etwa ${10 * Math.ceil(seconds / 10)} s`;
  if (seconds < 5400) return `etwa ${Math.round(seconds / 60)} min`;
  return `etwa ${Math.round(seconds / 3600)} h`;
}

export const large: typeof en = {
  size: "Größe der Fotos",
  full: "Voll",
  half: "Halb",
  quarter: "Viertel",
  cost: (photographs, pixels, cropped, bytes, time) => {
    const known = time?.measured
      ? ", so schnell wie der letzte Lauf"
      : ", wenn dieser Prozessor unserem gleicht und das Objekt das halbe Bild füllt";
    const when = time
      ? `${duration(time.seconds)}${known}`
      : "wie lange es hier dauert, zeigt der erste Lauf";
    return `${photographs} Fotos mit ${fixed(pixels / 1e6, 1)} Megapixeln${cropped ? " nach dem Zuschneiden" : ""}: etwa ${memory(bytes)} Speicher; ${when}.`;
  },
  lacking: (here) =>
    `Das ist mehr als die ${memory(here)}, die eine Seite hat: Der Lauf kann scheitern. Das Kommandozeilenprogramm hat diese Grenze nicht.`,
  noMemory: (here) => `Die volle Größe bräuchte mehr Speicher, als eine Seite hat (${memory(here)}).`,
  fixed: {
    deep: "hat 16 Bit je Wert, von denen Browser 8 behalten",
    undecoded: "hat ein Format, das Browser nicht lesen",
  },
  cropping: (photograph, of) => `Fotos werden zugeschnitten: ${photograph} von ${of}`,
  shrinking: (photograph, of) => `Fotos werden verkleinert: ${photograph} von ${of}`,
  croppingMask: "Die Maske wird zugeschnitten",
  notCropped: (file, reason) => `${file} lässt sich nicht zuschneiden: ${reason}`,
  notShrunk: (file, reason) => `${file} lässt sich nicht verkleinern: ${reason}`,
  otherSize: (own, others) =>
    `Es hat ${own.width} × ${own.height} Pixel, andere haben ${others.width} × ${others.height}`,
  outOfMemory: "nicht genug Speicher",
  taken: (crop, times, frame) => {
    const part = crop ? [`zugeschnitten auf ${rectangles.rectangle(crop)}`] : [];
    const size = times === 1 ? [] : [times === 2 ? "halb so groß" : "ein Viertel so groß"];
    const words = [...part, ...size].join(", ");
    return words && frame ? `${words}, aus ${frame.width} × ${frame.height} Pixeln` : words;
  },
  planLine: (taken) => `Fotos: ${taken}, als PNG mit 8 Bit, die die Seite daraus gemacht hat`,
};
