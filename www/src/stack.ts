import type { ColorMode, Notice, Plan } from "normalight";
import { FEWEST } from "./captures.js";
import { byId, make, paint, say, sayLines, wordsOf } from "./dom.js";
import type { Engine } from "./engine.js";
import { noticesByFile } from "./file_notices.js";
import { Roving } from "./roving.js";

/** Longer side of a thumbnail in pixels. */
const SIDE = 144;

/** The plan of no files. */
const NOTHING: Plan = { images: [], leftOut: [], notices: [], words: [] };

/** One file of the stack and its tile. */
interface Entry {
  readonly file: File;
  readonly tile: HTMLLIElement;
  readonly picture: HTMLCanvasElement;
  /** Colour mode the thumbnail was made with; none yet when missing. */
  shown?: ColorMode;
  problem?: string;
}

/** The files of the user: in their order, with thumbnails, and with what is wrong with them. */
export class Stack {
  readonly #engine: Engine;
  readonly #heard: { changed(): void; planned(): void };
  readonly #list = byId("thumbnails");
  readonly #roving = new Roving(this.#list, ".remove");
  readonly #problems = byId("file-problems");
  #entries: Entry[] = [];
  #plan: Plan = NOTHING;
  /** The archives that the files came out of. */
  #archives: readonly string[] = [];
  /** What is wrong with the files as a whole. */
  #problem = "";
  /** Ends the looking at files that are no longer asked for. */
  #looking = new AbortController();
  #color: ColorMode = "auto";

  /** Whether the plan is that of the files; no plan yet, or none that can be made, leaves the judgement to the run. */
  #planned = true;
  /** A single picture that may hold all photographs as its pages. */
  #pages = false;

  constructor(engine: Engine, heard: { changed(): void; planned(): void }) {
    this.#engine = engine;
    this.#heard = heard;
    this.#list.addEventListener("keydown", ({ key, target }) => {
      if (key === "Delete" || key === "Backspace") (target as HTMLElement).click();
    });
  }

  /** Why no run can begin with these files; empty when one can, as far as is known. */
  get lacking(): string {
    const { length } = this.#plan.images;
    if (this.#entries.length === 0) return "Choose three photographs or more.";
    if (!this.#planned || this.#pages || length >= FEWEST) return "";
    if (length === 0) return "There is no photograph among these files; three are needed.";
    return `${length === 1 ? "One photograph is" : "Two photographs are"} not enough: three are needed.`;
  }

  /** All files, photographs or not. */
  get files(): File[] {
    return this.#entries.map(({ file }) => file);
  }

  /** The photographs among the files, as far as the plan is known. */
  get photographs(): File[] {
    return this.#plan.images.flatMap((index) => this.#entries[index]?.file ?? []);
  }

  /** The mask among the files. */
  get mask(): File | undefined {
    return this.#entries[this.#plan.mask ?? -1]?.file;
  }

  /** The file of a name, as results give it: without the folders before it where that is clear. */
  fileOf(name: string): File | undefined {
    return this.#entryOf(name)?.file;
  }

  /** The thumbnail of a file. */
  pictureOf(name: string): HTMLCanvasElement | undefined {
    const entry = this.#entryOf(name);
    return entry?.tile.dataset.state === "shown" ? entry.picture : undefined;
  }

  #entryOf(name: string): Entry | undefined {
    const alike = this.#entries.filter(({ file }) => file.name.endsWith(`/${name}`));
    return (
      this.#entries.find(({ file }) => file.name === name) ?? (alike.length === 1 ? alike[0] : undefined)
    );
  }

  /** Shows on thumbnails what is doubtful about their files. */
  mark(notices: readonly Notice[]): void {
    for (const { tile } of this.#entries) tile.querySelector(".flag")?.remove();
    for (const [name, words] of noticesByFile(notices)) {
      const flag = make("span", "flag", "!");
      flag.setAttribute("role", "img");
      flag.setAttribute("aria-label", words);
      flag.title = words;
      this.#entryOf(name)?.tile.append(flag);
    }
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
    const picture = make("canvas");
    const remove = make("button", "remove", "×");
    remove.type = "button";
    remove.title = `Remove ${file.name}`;
    remove.setAttribute("aria-label", remove.title);
    const tile = make("li", "", picture, make("span", "name", file.name), remove);
    tile.title = file.name;
    const entry: Entry = { file, tile, picture };
    remove.tabIndex = -1;
    remove.addEventListener("click", () => this.#remove(entry));
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
    this.#problem = "";
    try {
      const unpacked = await this.#engine.with((normalight) => normalight.unpack(this.files));
      if (signal.aborted) return;
      if (unpacked && this.#archives.length === 0) {
        this.#entries = unpacked.files.map((file) => this.#entry(file));
        this.#archives = unpacked.archives;
        return await this.#look();
      }
      const plan = await this.#engine.with((normalight) => normalight.plan(this.files));
      if (signal.aborted) return;
      const single = plan.images.length === 1 ? this.files[plan.images[0] ?? 0] : undefined;
      this.#pages = single !== undefined && (await isTiff(single));
      if (signal.aborted) return;
      this.#plan = plan;
      this.#planned = true;
      this.mark(plan.notices);
      this.#show();
      this.#heard.planned();
      for (const index of [...plan.images, plan.mask]) {
        const entry = index === undefined ? undefined : entries[index];
        if (entry && entry.shown !== color) await this.#lookAt(entry, color, signal);
      }
    } catch (error) {
      if (signal.aborted) return;
      this.#plan = NOTHING;
      this.#problem = wordsOf(error);
      this.#show();
    }
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
    } catch (error) {
      if (signal.aborted) throw error;
      entry.shown = color;
      entry.problem = wordsOf(error);
      entry.tile.dataset.state = "bad";
      this.#show();
    }
  }

  #show(): void {
    const { images, mask } = this.#plan;
    const order = mask === undefined ? images : [...images, mask];
    const shown = order.flatMap((index) => this.#entries[index] ?? []);
    for (const entry of shown) entry.tile.classList.toggle("mask", entry === this.#entries[mask ?? -1]);
    const focused = document.activeElement;
    this.#list.replaceChildren(...shown.map(({ tile }) => tile));
    this.#roving.update();
    // Tiles that are put back lose the focus.
    if (focused instanceof HTMLElement && this.#list.contains(focused))
      focused.focus({ preventScroll: true });
    byId("stack").hidden = this.#entries.length === 0;
    byId("drop").classList.toggle("small", this.#entries.length > 0);
    byId("stack-words").textContent = this.#words();
    sayLines(byId("stack-notes"), this.#plan.words);
    const bad = shown.flatMap(({ problem }) => problem ?? []);
    this.#problems.hidden = bad.length === 0 && !this.#problem;
    if (this.#problem) say(this.#problems, this.#problem);
    else this.#problems.replaceChildren(...bad.map((words) => make("p", "", words)));
  }

  #words(): string {
    const { images, mask } = this.#plan;
    const words = [images.length === 1 ? "1 photograph" : `${images.length} photographs`];
    const maskFile = this.#entries[mask ?? -1];
    if (maskFile) words.push(`mask ${maskFile.file.name}`);
    const other = this.#entries.length - images.length - (maskFile ? 1 : 0);
    if (other > 0) words.push(other === 1 ? "1 other file" : `${other} other files`);
    if (this.#archives.length > 0) words.push(`out of ${this.#archives.join(", ")}`);
    return words.join(" · ");
  }
}

/** Whether a file is a TIFF or BigTIFF, which may hold several pictures. */
async function isTiff(file: File): Promise<boolean> {
  const head = await file.slice(0, 4).text();
  return /^(II[*+]\0|MM\0[*+])/.test(head);
}
