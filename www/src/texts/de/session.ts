import type { session as en } from "../en/session.js";
import { since } from "../numbers.js";

export const session: typeof en = {
  here: "Nur auf diesem Gerät gespeichert.",
  restore: "Wiederherstellen",
  forget: "Verwerfen",
  goOn: (name, photographs, time) =>
    `Weiter mit ${name} (${photographs === 1 ? "1 Foto" : `${photographs} Fotos`}, ${since(time)})`,
  kept: "Für ein Neuladen auf diesem Gerät gespeichert, bis Sie leeren oder andere wählen.",
  otherWindow: "Gespeichert sind für ein Neuladen die Fotos eines anderen Fensters, nicht diese.",
  notKept: (reason) => `Diese Fotos sind nicht für ein Neuladen gespeichert: ${reason}.`,
  stillKept: (reason) => `Die Fotos sind noch gespeichert: ${reason}`,
  unread: (reason) => `Was gespeichert war, lässt sich nicht lesen: ${reason}`,
  missing: "Es fehlen Fotos.",
  full: "In diesem Browser ist kein Platz mehr",
  tooLarge: (needed, free) => `Sie brauchen ${needed}, und dieser Browser nimmt noch ${free}`,
};
