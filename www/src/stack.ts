import type { ColorMode, Notice, Plan } from "normalight";
import { asAmbient } from "./ambient.js";
import { FEWEST } from "./captures.js";
import { byId, english, make, paint, sayError, sayLines, wordsOf } from "./dom.js";
import type { Engine } from "./engine.js";
import { withoutExtension } from "./large/shrink.js";
import { noticesByFile } from "./notices_by_file.js";
import { Roving } from "./roving.js";
import { texts } from "./texts/texts.js";
import { type Entry, entryOf, flag } from "./tile.js";

/** Longer side of a thumbnail in pixels. */
const SIDE = 144;

/** The plan of no files. */
const NOTHING: Plan = { images: [], leftOut: [], notices: [], words: [] };

/** Who hears of the files. */
interface Heard {
  /** There are others. */
  changed(): void;
  /** It is known what they are. */
  planned(): void;
  /** One more can be seen. */
  pictured(): void;
}

/** The files of the user: in their order, with thumbnails, and with what is wrong with them. */
export class Stack {
  readonly #engine: Engine;
  readonly #heard: Heard;
  readonly #list = byId("thumbnails");
  readonly #roving = new Roving(this.#list, ".remove");
  readonly #problems = byId("file-problems");
  #entries: Entry[] = [];
  #plan: Plan = NOTHING;
  /** The photograph that was marked as taken without the lamp, and the file that tells the estimator so. */
  #ambient: { readonly entry: Entry; readonly file: File } | undefined;
  /** A list of the user names that photograph: it must stay where it is, and its file is one more. */
  #ambientListed = false;
  /** The archives that the files came out of. */
  #archives: readonly string[] = [];
  /** What is wrong with the files as a whole. */
  #problem: unknown;
  /** Ends the looking at files that are no longer asked for. */
  #looking = new AbortController();
  #color: ColorMode = "auto";

  /** Whether the plan is that of the files; no plan yet, or none that can be made, leaves the judgement to the run. */
  #planned = true;
  /** A single picture that may hold all photographs as its pages. */
  #pages = false;

  constructor(engine: Engine, heard: Heard) {
    this.#engine = engine;
    this.#heard = heard;
    this.#list.addEventListener("keydown", ({ key, target }) => {
      if (key === "Delete" || key === "Backspace") (target as HTMLElement).click();
    });
  }

  /** Whether it is known what the files are. */
  get planned(): boolean {
    return this.#planned;
  }

  /** Why no run can begin with these files; empty when one can, as far as is known. */
  get lacking(): string {
    const { length } = this.photographs;
    if (this.#entries.length === 0) return texts.stack.none;
    if (!this.#planned || this.#pages || length >= FEWEST) return "";
    if (length === 0) return texts.stack.noPhotograph;
    return texts.stack.tooFew(length);
  }

  /** All files, photographs or not, as the estimator is to get them. */
  get files(): File[] {
    const { entry: marked, file: ambient } = this.#ambient ?? {};
    if (!ambient || this.#ambientListed)
      return [...this.#entries.map(({ file }) => file), ...(ambient ? [ambient] : [])];
    return this.#entries.map((entry) => (entry === marked ? ambient : entry.file));
  }

  /** The photographs among the files, as far as the plan is known. */
  get photographs(): File[] {
    const entries = this.#plan.images.flatMap((index) => this.#entries[index] ?? []);
    return entries.filter((entry) => entry !== this.#ambient?.entry).map(({ file }) => file);
  }

  /** The files that may be taken without the lamp: all photographs, and those that say so in their names. */
  get lampless(): { files: readonly File[]; marked: File | undefined; named: readonly File[] } {
    const named = this.#namedAmbient.map(({ file }) => file);
    const marked = this.#ambient?.entry.file;
    const among = new Set([...this.photographs, ...named, ...(marked ? [marked] : [])]);
    // In the order of the list, so that the marked one keeps its place.
    const files = this.#entries.map(({ file }) => file).filter((file) => among.has(file));
    return { files, marked, named };
  }

  /** Says which photograph was taken without the lamp; none, or none that is known. */
  markAmbient(file: File | undefined): void {
    const entry = this.#entries.find((other) => other.file === file);
    if (entry === this.#ambient?.entry) return;
    this.#ambient = entry && { entry, file: asAmbient(entry.file) };
    this.#lookAgain();
  }

  /** What the plan takes for photographs without lamp, by their names; not the marked one. */
  get #namedAmbient(): Entry[] {
    const left = this.#plan.leftOut.filter(({ reason }) => reason.kind === "ambient");
    const entries = left.flatMap(({ file }) => this.#entryOf(file) ?? []);
    return entries.filter((entry) => entry !== this.#ambient?.entry);
  }

  /** All files that show the object, with the lamp or without, among {@link files}. */
  get pictures(): ReadonlySet<File> {
    const { marked, named } = this.lampless;
    const ambient = marked && this.#ambient ? [this.#ambient.file] : [];
    return new Set([...this.photographs, ...named, ...ambient]);
  }

  /** The mask among the files. */
  get mask(): File | undefined {
    return this.#entries[this.#plan.mask ?? -1]?.file;
  }

  /** The file of a name, as results give it: without the folders before it where that is clear. */
  fileOf(name: string): File | undefined {
    const entry = this.#entryOf(name);
    return entry && entry === this.#ambient?.entry ? this.#ambient.file : entry?.file;
  }

  /** The thumbnail of a file. */
  pictureOf(name: string): HTMLCanvasElement | undefined {
    const entry = this.#entryOf(name);
    return entry?.tile.dataset.state === "shown" ? entry.picture : undefined;
  }

  #entryOf(name: string): Entry | undefined {
    const ambient = this.#ambient;
    if (ambient && (ambient.file.name === name || ambient.file.name.endsWith(`/${name}`)))
      return ambient.entry;
    const alike = this.#entries.filter(({ file }) => file.name.endsWith(`/${name}`));
    // Photographs that were made smaller have another extension.
    const stem = withoutExtension(name);
    const akin = this.#entries.filter(({ file }) => withoutExtension(file.name) === stem);
    return (
      this.#entries.find(({ file }) => file.name === name) ??
      (alike.length === 1 ? alike[0] : akin.length === 1 ? akin[0] : undefined)
    );
  }

  /** Shows on thumbnails what is doubtful about their files. */
  mark(notices: readonly Notice[]): void {
    for (const { tile } of this.#entries) tile.querySelector(".flag")?.remove();
    for (const [name, words] of noticesByFile(notices)) this.#entryOf(name)?.tile.append(flag(words));
  }

  /** Takes other files; `keep` adds them, and replaces those of the same name. */
  take(files: Iterable<File>, keep = false): void {
    const added = [...files].map((file) => this.#entry(file));
    const names = new Set(added.map(({ file }) => file.name));
    const kept = keep ? this.#entries.filter(({ file }) => !names.has(file.name)) : [];
    this.#entries = [...kept, ...added];
    if (!keep) this.#archives = [];
    this.#lookAgain();
  }

  /** How samples are to be taken: thumbnails show it. */
  set color(color: ColorMode) {
    this.#color = color;
    this.#lookAgain();
  }

  #entry(file: File): Entry {
    const entry = entryOf(file, () => this.#remove(entry));
    return entry;
  }

  #remove(entry: Entry): void {
    const { controls } = this.#roving;
    const at = controls.findIndex((control) => entry.tile.contains(control));
    this.#entries = this.#entries.filter((other) => other !== entry);
    // The focus would be lost with the tile: its neighbour gets it.
    (controls[at + 1] ?? controls[at - 1] ?? byId("pick-files")).focus();
    entry.tile.remove();
    this.#lookAgain();
  }

  /** The files or their colour have changed. */
  #lookAgain(): void {
    if (this.#ambient && !this.#entries.includes(this.#ambient.entry)) this.#ambient = undefined;
    // Said at once: the words of a run that begins before all files are looked at must stay.
    this.#planned = this.#entries.length === 0;
    this.#heard.changed();
    void this.#look();
  }

  /** Finds out what the files are, and shows the photographs one after the other. */
  async #look(): Promise<void> {
    this.#looking.abort();
    this.#looking = new AbortController();
    const { signal } = this.#looking;
    const [entries, color] = [this.#entries, this.#color];
    this.#problem = undefined;
    try {
      // Where a photograph is marked, everything is unpacked.
      const unpacked = this.#ambient
        ? undefined
        : await this.#engine.with((normalight) => normalight.unpack(this.files));
      if (signal.aborted) return;
      if (unpacked && this.#archives.length === 0) {
        this.#entries = unpacked.files.map((file) => this.#entry(file));
        this.#archives = unpacked.archives;
        return await this.#look();
      }
      const plan = await this.#planOf();
      if (signal.aborted) return;
      const single = plan.images.length === 1 ? this.files[plan.images[0] ?? 0] : undefined;
      this.#pages = single !== undefined && (await isTiff(single));
      if (signal.aborted) return;
      this.#plan = plan;
      this.#planned = true;
      this.mark(plan.notices);
      this.#show();
      this.#heard.planned();
      for (const entry of this.#shown) {
        if (entries.includes(entry) && entry.shown !== color) await this.#lookAt(entry, color, signal);
      }
    } catch (error) {
      if (signal.aborted) return;
      this.#plan = NOTHING;
      this.#problem = error;
      this.#show();
    }
  }

  async #planOf(): Promise<Plan> {
    const ask = () => this.#engine.with((normalight) => normalight.plan(this.files));
    this.#ambientListed = false;
    if (!this.#ambient) return await ask();
    const at = this.#entries.indexOf(this.#ambient.entry);
    const plan = await ask().catch(() => undefined);
    if (plan && !plan.images.includes(at)) return plan;
    // It has another name than the list gives it, or the list decides against the name.
    this.#ambientListed = true;
    return await ask();
  }

  async #lookAt(entry: Entry, color: ColorMode, signal: AbortSignal): Promise<void> {
    const options = { color, side: SIDE, signal };
    try {
      const { width, height, rgba } = await this.#engine.with((normalight) =>
        normalight.thumbnail(entry.file, options),
      );
      paint(entry.picture, width, height, rgba);
      entry.shown = color;
      entry.tile.dataset.state = "shown";
      this.#heard.pictured();
    } catch (error) {
      if (signal.aborted) throw error;
      entry.shown = color;
      entry.problem = error;
      entry.tile.dataset.state = "bad";
      this.#show();
    }
  }

  /** What is shown as thumbnails: photographs, those without lamp, and the mask. */
  get #shown(): Entry[] {
    const { images, mask } = this.#plan;
    const photographs = images.flatMap((index) => this.#entries[index] ?? []);
    const maskEntry = this.#entries[mask ?? -1];
    const marked = this.#ambient?.entry;
    const others = [...this.#namedAmbient, ...(marked ? [marked] : []), ...(maskEntry ? [maskEntry] : [])];
    return [...photographs.filter((entry) => !others.includes(entry)), ...others];
  }

  #show(): void {
    const shown = this.#shown;
    for (const entry of shown) {
      entry.tile.classList.toggle("mask", entry === this.#entries[this.#plan.mask ?? -1]);
      entry.tile.classList.toggle("ambient", entry === this.#ambient?.entry);
    }
    const focused = document.activeElement;
    this.#list.replaceChildren(...shown.map(({ tile }) => tile));
    this.#roving.update();
    // Tiles that are put back lose the focus.
    if (focused instanceof HTMLElement && this.#list.contains(focused))
      focused.focus({ preventScroll: true });
    byId("stack").hidden = this.#entries.length === 0;
    byId("drop").classList.toggle("small", this.#entries.length > 0);
    byId("stack-words").textContent = this.#words();
    sayLines(byId("stack-notes"), texts.plan.ofFiles(this.#plan));
    const bad = shown.flatMap(({ problem }) => problem ?? []);
    this.#problems.hidden = bad.length === 0 && !this.#problem;
    if (this.#problem) sayError(this.#problems, this.#problem);
    else this.#problems.replaceChildren(...paragraphsAbout(bad));
  }

  #words(): string {
    const { length } = this.photographs;
    const words = [texts.stack.photographs(length)];
    const marked = this.#ambient?.entry;
    if (marked) words.push(texts.stack.ambient(marked.file.name));
    const maskFile = this.#entries[this.#plan.mask ?? -1];
    if (maskFile) words.push(texts.stack.mask(maskFile.file.name));
    const other = this.#entries.length - length - (marked ? 1 : 0) - (maskFile ? 1 : 0);
    if (other > 0) words.push(texts.stack.others(other));
    if (this.#archives.length > 0) words.push(texts.stack.archives(this.#archives));
    return words.join(" · ");
  }
}

/** What is wrong with single files, in the estimator's words: what kind of failure it is is said once. */
function paragraphsAbout(errors: readonly unknown[]): HTMLElement[] {
  const before = errors.length > 0 && texts.errors.before?.input;
  const each = errors.map((error) => make("p", "", english(wordsOf(error))));
  return before ? [make("p", "", `${before}:`), ...each] : each;
}

/** Whether a file is a TIFF or BigTIFF, which may hold several pictures. */
async function isTiff(file: File): Promise<boolean> {
  const head = await file.slice(0, 4).text();
  return /^(II[*+]\0|MM\0[*+])/.test(head);
}
