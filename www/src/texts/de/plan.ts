import type { ColorReason, InputPlan, LeftOut, LeftOutReason, NameMatch, Notice } from "normalight";
import type { plan as en } from "../en/plan.js";
import type { Line } from "../lines.js";
import { fixed } from "../numbers.js";
import { large } from "./large.js";
import { type Said, said, someNames } from "./notices.js";

type Reasons = {
  readonly [Kind in LeftOutReason["kind"]]: (reason: Extract<LeftOutReason, { kind: Kind }>) => string;
};

const LEFT_OUT: Reasons = {
  mask: () => "eine weitere Maske",
  ambient: () => "ohne Lampe, dem Namen nach",
  "shows-no-lamp": () => "zeigt keine Lampe",
  map: ({ word }) => `eine Karte, nach „${word}“ im Namen`,
  "not-listed": () => "nicht in der Liste",
  "other-size": ({ size }) => `andere Größe: ${size.join(" × ")}`,
  "unlike-names": () => "anders benannt als die Fotos; eine Liste von Namen nimmt es auf",
  "too-dark": () => "schwarz oder fast schwarz",
  "unread-format": ({ format }) =>
    `${format}, wird nicht gelesen; exportieren Sie es als TIFF oder PNG mit 16 Bit`,
  archive: () => "ein Archiv, nicht geöffnet: Wählen Sie es allein",
  link: () => "eine Verknüpfung, der nicht gefolgt wird",
  "other-folder": () => "in einem anderen Ordner als die Fotos",
  "not-an-image": () => "kein Bild",
  system: () => "eine Hilfsdatei des Systems",
};

const COLOR: Record<ColorReason, string> = {
  asked: "wie eingestellt",
  stated: "wie die Dateien sagen",
  benchmark: "Dateien eines Benchmarks",
  shading: "die Schattierung passt so besser",
  usual: "üblich bei solchen Dateien",
};

const MATCHED: Record<NameMatch, string> = {
  full: "Namen",
  "path-end": "Namen ohne Ordner",
  stem: "Namen ohne Endungen",
  number: "Zahlen in den Namen",
  position: "Reihenfolge",
};

/** Where a mask came from, in the estimator's words; anything else is the name of its file. */
const MASKS: Record<string, string> = {
  "transparency of the first image": "Transparenz des ersten Bilds",
  "told from the photographs": "aus den Fotos erkannt",
  "whole frame": "ganzes Bild",
};

function photographs({ photographs: names, order }: InputPlan): string {
  const [first, last] = [names[0], names.at(-1)];
  const by = order === "names" ? "nach Namen" : `in der Reihenfolge von ${order.list}`;
  const which = names.length > 1 ? `${first} bis ${last}` : (first ?? "");
  return `Fotos: ${names.length} (${by}): ${which}`;
}

function lights({ lights: given }: InputPlan): string[] {
  if (!given) return [];
  const { file, intensities, matched } = given;
  const beside = intensities && intensities !== file ? `, mit den Helligkeiten in ${intensities}` : "";
  return [`Lichter: ${file}${beside}, zugeordnet nach ${MATCHED[matched]}`];
}

function aligned({ aligned: most }: InputPlan): string[] {
  if (most === undefined) return [];
  return [
    most === 0
      ? "Ausgerichtet: Kein Foto musste verschoben werden"
      : `Ausgerichtet: Fotos um bis zu ${fixed(most, 1)} Pixel verschoben`,
  ];
}

function leftOut(files: readonly LeftOut[]): Line[] {
  const told = files
    .filter(({ reason }) => reason.kind !== "system")
    .map(({ file, reason }) => {
      const words = LEFT_OUT[reason.kind] as (reason: LeftOutReason) => string;
      return `${file} (${words(reason)})`;
    });
  return told.length === 0 ? [] : [{ words: `Ausgelassen: ${someNames(told)}` }];
}

/** A line for each notice; one for the same about several files. */
function doubtful(notices: readonly Notice[]): Line[] {
  const gathered: Said[] = [];
  for (const one of notices.map(said)) {
    const at = gathered.findIndex(
      ({ files, words, english }) => files.length > 0 && words === one.words && english === one.english,
    );
    const same = gathered[at];
    if (same) gathered[at] = { ...same, files: [...same.files, ...one.files] };
    else gathered.push(one);
  }
  return gathered.map(({ files, words, ...rest }) => {
    const about = files.length === 0 ? "" : `${someNames(files)}: `;
    const whole = about === "" ? words.charAt(0).toUpperCase() + words.slice(1) : `${about}${words}`;
    return { words: whole, doubtful: true, ...rest };
  });
}

export const plan: typeof en = {
  ofFiles: ({ leftOut: files, notices }) => [...leftOut(files), ...doubtful(notices)],
  ofRun: (input, _words, taken) => {
    const { mask, color, ambient, truth, left_out, notices } = input;
    const lines = [
      ...(taken ? [large.planLine(taken)] : []),
      photographs(input),
      `Maske: ${MASKS[mask] ?? mask}`,
      `Farbe: ${color.taken} (${COLOR[color.because]})`,
      ...lights(input),
      ...(ambient ? [`Raumlicht: das von ${ambient}, abgezogen`] : []),
      ...(truth ? [`Wahre Normalen: ${truth}, zum Vergleichen`] : []),
      ...aligned(input),
    ];
    return [...lines.map((words) => ({ words })), ...leftOut(left_out), ...doubtful(notices)];
  },
};
