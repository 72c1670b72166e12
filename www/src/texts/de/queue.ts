import type { Term } from "../../queue/state.js";
import type { queue as English } from "../en/queue.js";
import { fixed } from "../numbers.js";

const done = (done: number, of: number, failed: number) =>
  `${done} von ${of} Sätzen fertig${failed > 0 ? `, ${failed} gescheitert` : ""}`;

const TERMS: Readonly<Record<Term, string>> = {
  page: "Die Ergebnisse bleiben auf diesem Gerät, bis diese Seite geschlossen wird.",
  memory:
    "Dieser Browser hat keinen Platz für Ergebnisse; sie bleiben im Speicher dieser Seite, bis sie geschlossen wird.",
  reload:
    "Die Ergebnisse und ihre Fotos bleiben auf diesem Gerät, auch wenn die Seite neu lädt, bis Sie sie verwerfen.",
  "no-room":
    "Die Ergebnisse bleiben auf diesem Gerät, bis diese Seite geschlossen wird: Für alle Fotos dazu hat dieser Browser keinen Platz.",
};

export const queue: typeof English = {
  states: {
    waiting: "wartet",
    now: "wird gerade geschätzt",
    cancelled: "nicht geschätzt: abgebrochen",
    interrupted: "nicht geschätzt: die Seite wurde geschlossen",
  },
  failed: (why) => `gescheitert: ${why}`,
  done: (photographs, width, height, how, seconds) =>
    `${photographs} Fotos mit ${width} × ${height} Pixeln${how && `, ${how}`}; ${fixed(seconds, 1)} s`,
  show: "Zeigt dieses Ergebnis",
  stack: (number, of, name) => `Satz ${number} von ${of}, ${name}`,
  sofar: (finished, of, failed, term) => `${done(finished, of, failed)}. ${TERMS[term]}`,
  end: (finished, of, failed, seconds) => {
    const cancelled = finished + failed < of ? " Abgebrochen; was fertig ist, bleibt." : "";
    return `${done(finished, of, failed)} in ${fixed(seconds, 0)} s.${cancelled}`;
  },
  notKept: "Dieses Ergebnis wurde nicht behalten.",
  deleted: "Der Browser hat dieses Ergebnis gelöscht.",
};
