import type { Notice } from "normalight";
import type { NoticeKind, NoticeOf } from "../notice_words.js";
import { fixed, percent } from "../numbers.js";

/** What a notice says, without the files that it is about. */
type Words = { readonly [Kind in NoticeKind]: (notice: NoticeOf<Kind>) => string };

/** The sides that lights may come from, as the estimator names them. */
const SIDES: Record<string, string> = {
  "the right": "von rechts",
  "the upper right": "von rechts oben",
  above: "von oben",
  "the upper left": "von links oben",
  "the left": "von links",
  "the lower left": "von links unten",
  below: "von unten",
  "the lower right": "von rechts unten",
};

/** A share of full scale; of tiny ones their digits too. */
function short(value: number): string {
  const tiny = value !== 0 && Math.abs(value) < 0.01;
  return tiny ? value.toExponential(1).replace(".", ",") : fixed(value, 3);
}

/** Some names: all of a few, else the first and how many more. */
export function someNames(names: readonly string[]): string {
  const shown = names.slice(0, 6).join(", ");
  return names.length > 6 ? `${shown} und ${names.length - 6} weitere` : shown;
}

function sureness(sure: number | undefined): string {
  if (sure === undefined) return ", wie es bei solchen Dateien üblich ist";
  return sure > 0.5
    ? ` nach ihrer Schattierung (zu ${percent(sure)} % sicher)`
    : " nach ihrer Schattierung, was kaum besser ist als geraten";
}

const WORDS: Words = {
  "content-over-extension": ({ content, extension }) =>
    extension === ""
      ? `hat keine Endung; dem Inhalt nach als ${content} gelesen`
      : `der Inhalt ist ${content}, obwohl die Endung „${extension}“ ist; als ${content} gelesen`,
  "decoded-by-browser": ({ format }) => `${format}, von diesem Browser als sRGB mit 8 Bit gelesen`,
  "from-archive": ({ folder }) =>
    `ein Archiv, gelesen ohne es auf die Platte zu entpacken${folder && `; Fotos aus seinem Ordner ${folder}`}`,
  "one-in-each-folder": () => "die Fotos liegen je eines in den Ordnern hier und gelten als ein Satz",
  "pages-as-photographs": ({ pages }) => `die ${pages} Seiten sind die Fotos`,
  "list-by-stem": () => "nennt Dateien mit anderen Endungen; ohne diese zugeordnet",
  "list-ignored": () => "dem Namen nach eine Liste von Ausschuss, nicht als Liste der Fotos genommen",
  "several-pages": ({ pages, page }) =>
    `hat ${pages} Seiten, genommen wurde Seite ${page}; um andere zu benutzen, speichern Sie sie als eigene Dateien`,
  animation: () => "eine Animation, von der das erste Bild genommen wurde",
  "several-layers": ({ taken, others }) =>
    `enthält mehrere Bilder; genommen wurde ${taken}, nicht ${someNames(others)}`,
  "extra-channels": ({ channels }) =>
    channels === 1
      ? "ein Kanal neben den Farben wurde ausgelassen"
      : `${channels} Kanäle neben den Farben wurden ausgelassen`,
  infinite: ({ samples }) => `${samples} unendliche Werte, als hellster endlicher Wert genommen`,
  "not-numbers": ({ samples }) => `${samples} Werte sind keine Zahlen (NaN); als schwarz genommen`,
  "truth-unread": () => "mit den wahren Normalen wird nichts verglichen",
  orientations: () =>
    "laut EXIF anders gedreht als die übrigen Fotos; die Pixel aller Fotos wurden genommen, wie sie gespeichert sind",
  "profile-not-understood": ({ taken }) =>
    `was die Datei über ihre Farben sagt, wird nicht verstanden; als ${taken} genommen`,
  "color-unstated": ({ taken, sure }) =>
    `nichts in den Fotos sagt, wie sich ihre Zahlen zum Licht verhalten; als ${taken} genommen${sureness(sure)}; die Einstellung „Farbe“ bestimmt es anders`,
  "color-mixed": ({ said }) =>
    `die Fotos sagen Verschiedenes über ihre Farben; jedes wurde so gelesen, wie es sagt: ${someNames(said)}`,
  "looks-otherwise": ({ taken, looks, factor, sure }) =>
    `die Fotos wurden als ${taken} genommen, sehen aber nach ${looks} aus (was sie ${fixed(factor, 1)}-mal besser erklärt; zu ${percent(sure)} % sicher); wenn das stimmt, wählen Sie es unter „Farbe“`,
  "mask-labels": ({ parts }) => `enthält neben dem Hintergrund ${parts} Teile, alle als Objekt genommen`,
  "mask-soft": ({ share }) =>
    `${percent(share)} % davon sind weder dunkel noch hell, wie in einem Foto; innen ist, was über der Mitte liegt`,
  "mask-full": () => "das ganze Bild liegt innen",
  "mask-scaled": ({ from, to }) =>
    `hat ${from.join(" × ")} Pixel, auf die ${to.join(" × ")} der Fotos gebracht`,
  "mask-from-transparency": () =>
    "die Farben zeigen keine Maske, daher wurde die Transparenz als solche genommen",
  "mask-inverted": () => "am Rand des Bilds hell und innen dunkel; umgekehrt genommen",
  "mask-values": ({ values, above }) =>
    `enthält die Werte ${values.map(short).join("; ")}; innen ist, was über ${short(above)} liegt`,
  "mask-guessed-whole": () =>
    "es gibt keine Maske, und kein Objekt hob sich von einem Hintergrund ab, daher wurde das ganze Bild genommen; gibt es einen Hintergrund, geben Sie eine Maske an",
  "mask-guess-unsure": ({ certainty }) =>
    `es gibt keine Maske; das Objekt wurde aus den Fotos erkannt, die ${percent(certainty)} % seines Umrisses bestätigen: Sehen Sie sich die Maske an, oder geben Sie eine an`,
  "nearly-identical": () => "fast dasselbe Bild; hat sich das Licht bewegt?",
  black: () => "schwarz innerhalb der Maske",
  saturated: ({ share }) => `bis zu ${percent(share)} % des Objekts sind übersteuert; belichten Sie kürzer`,
  overexposed: ({ share }) =>
    `${percent(share)} % des Objekts sind über alle Fotos übersteuert, dort ist keine Schattierung zu sehen: Belichten Sie kürzer`,
  "lamp-hardly-moved": ({ difference }) =>
    `alle Fotos zeigen fast dieselbe Schattierung (sie unterscheiden sich höchstens um ${fixed(100 * difference, 1)} %); hat sich die Lampe bewegt?`,
  "room-lit": () =>
    "heller und flacher als alle anderen; war es keine starke Lampe neben der Kamera, sondern ein anderes Licht, lassen Sie es weg",
  "ambient-left-out": () =>
    "zeigt das Objekt ohne Lampe und wurde ausgelassen; sein Licht lässt sich mit der Einstellung „Ohne Lampe aufgenommen“ von allen Fotos abziehen",
  "no-ambient": () =>
    "kein Foto ohne Lampe wurde erkannt, weder am Namen noch an dem, was es zeigt; nichts wurde abgezogen",
  "ambient-brighter": ({ share }) =>
    `auf ${percent(share)} % des Objekts heller als die Fotos, also mit anderer Belichtung oder anderem Licht aufgenommen; was dort abgezogen wurde, ist falsch`,
  "camera-moved": ({ pixels }) =>
    `liegt bis zu ${fixed(pixels, 1)} Pixel neben den anderen Fotos, Kamera oder Objekt haben sich also bewegt; „Fotos ausrichten“ behebt das`,
  unlike: () =>
    "zeigt nichts von dem, was die anderen Fotos zeigen; ein anderes Objekt, unscharf oder weit verschoben?",
  "lights-count-line": ({ said, found }) => `die erste Zeile nennt ${said} Lichter, es folgen aber ${found}`,
  "lights-unused": ({ lights }) =>
    lights === 1
      ? "eines der Lichter gehört zu keinem benutzten Foto"
      : `${lights} der Lichter gehören zu keinem benutzten Foto`,
  "lights-by-position": () =>
    "keiner der Namen ist der eines Fotos, daher wurden die Lichter nach der Reihenfolge zugeordnet",
  "lights-not-unit": ({ shortest, longest }) =>
    `Vektoren der Länge ${fixed(shortest, 3)} bis ${fixed(longest, 3)}; nur ihre Richtungen wurden benutzt`,
  "lights-behind": ({ behind, of }) => `${behind} von ${of} Lichtern liegen hinter dem Objekt (z negativ)`,
  "lights-without-intensity": ({ found }) =>
    found
      ? "enthält nur Richtungen; wie hell jedes Licht ist, wurde aus den Fotos ermittelt"
      : "enthält nur Richtungen, und die Fotos verraten nicht, wie hell jedes Licht ist: Alle gelten als gleich hell",
  "lights-contradict": ({ axes }) =>
    `die Fotos widersprechen diesen Lichtern, denn der Umriss des Objekts wird zu ihnen hin nicht heller; ${
      axes === undefined
        ? "prüfen Sie, ob jedes zu seinem Foto gehört und wie die Achsen zeigen"
        : `mit den Achsen ${axes} würde er es`
    }`,
  "lights-in-plane": ({ degrees }) =>
    `alle Lichter liegen fast in einer Ebene mit dem Objekt (bis auf ${fixed(degrees, 0)} Grad); wie sich die Oberfläche quer dazu neigt, ist nicht zu erkennen, und Normalen können weit danebenliegen; bewegen Sie die Lampe nach allen Seiten`,
  "lights-one-sided": ({ side, dark }) =>
    `alle Lichter kamen ${SIDES[side] ?? "von einer Seite"} (auf ${fixed(dark, 0)} Grad des Kreises ist keines); was von ihnen abgewandt ist, wurde nie beleuchtet, und seine Normalen sind geraten`,
  "lights-as-angles": ({ unit }) =>
    `die Winkel gelten als ${unit === "degrees" ? "Grad" : "Bogenmaß"}, der Azimut von rechts nach oben`,
};

/** What a notice says, the files that it is about, and what of it is English. */
export interface Said {
  readonly files: readonly string[];
  readonly words: string;
  readonly english?: string;
}

export function said(notice: Notice): Said {
  // The table has the very function for the kind, which the compiler cannot follow.
  const words = (WORDS[notice.kind] as ((notice: Notice) => string) | undefined)?.(notice) ?? notice.kind;
  const english = "reason" in notice ? { english: notice.reason } : {};
  return { files: filesOf(notice), words, ...english };
}

function filesOf(notice: Notice): readonly string[] {
  if ("files" in notice) return notice.files;
  if ("file" in notice) return [notice.file];
  if ("list" in notice) return [notice.list];
  return "archive" in notice ? [notice.archive] : [];
}
