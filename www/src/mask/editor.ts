import type { ObjectMask } from "normalight";
import { make, sayError } from "../dom.js";
import { texts } from "../texts/texts.js";
import { MaskDocument } from "./document.js";
import { MaskPanel } from "./panel.js";
import type { Operation, Picture, Pixels } from "./protocol.js";
import { scaled } from "./scaled.js";
import { MaskStage } from "./stage.js";
import { INSIDE } from "./tiles.js";
import { button, TOOLS } from "./toolbar.js";
import { MaskView } from "./view.js";
import { MaskWork } from "./work.js";

/** What is edited, and where everything comes from. */
export interface EditorInput {
  readonly photographs: readonly File[];
  /** The mask to begin with: of the estimator, a file, or a value for all pixels. */
  readonly begin: () => Promise<ObjectMask | File | number>;
  /** The mask that the estimator would take by itself; nothing where it does not tell. */
  readonly automatic: () => Promise<ObjectMask | undefined>;
  /** The pixels of a photograph that the browser does not decode. */
  readonly pixelsOf: (photograph: File) => Promise<Pixels>;
}

/** Lets people draw a mask; the file of it, or nothing when they leave without. */
export async function editMask(input: EditorInput): Promise<File | undefined> {
  const work = new MaskWork();
  try {
    return await new MaskEditor(input, work, await opened(input, work, 0)).edited;
  } finally {
    work.close();
  }
}

async function opened(
  { photographs, pixelsOf }: EditorInput,
  work: MaskWork,
  index: number,
): Promise<Picture> {
  const file = photographs[index];
  if (file === undefined) throw new Error(texts.mask.noPhotograph);
  try {
    return await work.do("open", file);
  } catch {
    // Not a format of browsers: the estimator decodes it.
    const pixels = await pixelsOf(file);
    return await work.do("open", pixels, [pixels.rgba.buffer]);
  }
}

class MaskEditor {
  readonly edited: Promise<File | undefined>;
  readonly #input: EditorInput;
  readonly #work: MaskWork;
  readonly #dialog = make("dialog", "mask-editor");
  readonly #words = make("p", "mask-words");
  readonly #document: MaskDocument;
  readonly #view: MaskView;
  readonly #stage: MaskStage;
  readonly #panel: MaskPanel;
  readonly #undo = button("undo", texts.mask.undo, texts.mask.undoTitle, () => this.#document.undo());
  readonly #redo = button("redo", texts.mask.redo, texts.mask.redoTitle, () => this.#document.redo());
  readonly #done = button("done", texts.mask.done, texts.mask.doneTitle, () => this.#finish());
  #end: (file: File | undefined) => void = () => {};
  /** Heavy things under way. */
  #busy = 0;
  #counting = 0;
  #warned = false;

  constructor(input: EditorInput, work: MaskWork, picture: Picture) {
    this.#input = input;
    this.#work = work;
    const { width, height } = picture;
    this.#document = new MaskDocument(width, height, work, (box) => {
      this.#view.changed(box);
      if (box === undefined) this.#tell();
    });
    this.#view = new MaskView(this.#document.tiles, picture, () => this.#stage.draw());
    this.#stage = new MaskStage(this.#document, this.#view);
    this.#panel = this.#controls(Math.max(width, height) / 4);
    this.#build();
    this.#panel.tools.choose("brush");
    this.#panel.lightened = picture.dark;
    this.edited = new Promise((resolve) => {
      this.#end = resolve;
    });
    document.body.append(this.#dialog);
    this.#dialog.showModal();
    this.#stage.element.focus();
    void this.#begin();
  }

  #controls(largest: number): MaskPanel {
    const names = this.#input.photographs.map(({ name }) => name);
    return new MaskPanel(names, largest, {
      tool: (tool) => {
        this.#stage.tool = tool;
      },
      radius: (pixels) => {
        this.#stage.radius = pixels;
      },
      operate: (operation) => void this.#operate(operation),
      fill: (inside) => this.#document.fill(inside ? INSIDE : 0),
      automatic: () => void this.#automatic(),
      load: (file) => void this.#while(texts.mask.loading(file.name), () => this.#load(file)),
      show: (index) =>
        void this.#while(texts.mask.loadingPhotograph, async () =>
          this.#view.show(await opened(this.#input, this.#work, index)),
        ),
      lighten: (lightened) => this.#view.lighten(lightened),
    });
  }

  #build(): void {
    const title = make("h2", "", texts.mask.title);
    title.id = "mask-editor-title";
    this.#dialog.setAttribute("aria-labelledby", title.id);
    this.#words.setAttribute("role", "status");
    this.#done.classList.add("accent");
    const head = make(
      "header",
      "mask-head",
      title,
      this.#words,
      make("div", "mask-row", this.#undo, this.#redo),
      make(
        "div",
        "mask-row",
        button("closer", "+", texts.mask.largerTitle, () => this.#view.zoom(1.4)),
        button("farther", "−", texts.mask.smallerTitle, () => this.#view.zoom(1 / 1.4)),
        button("fit", texts.mask.fit, texts.mask.fitTitle, () => this.#view.fit()),
        button("pixels", "1:1", texts.mask.actualTitle, () => this.#view.zoom(1 / this.#view.scale)),
      ),
      make(
        "div",
        "mask-row",
        button("cancel", texts.mask.cancel, texts.mask.cancelTitle, () => this.#close()),
        this.#done,
      ),
    );
    this.#dialog.append(head, make("div", "mask-body", this.#stage.element, this.#panel.element));
    this.#dialog.addEventListener("keydown", (event) => this.#key(event));
    this.#dialog.addEventListener("cancel", (event) => {
      if (this.#stage.dropPolygon() || this.#warns()) event.preventDefault();
      else this.#close();
    });
  }

  /** Shows the mask that counts now; whoever does not wait for it and begins to paint keeps what is painted. */
  async #begin(): Promise<void> {
    this.#say(texts.mask.looking);
    const { history } = this.#document;
    try {
      const mask = await this.#input.begin();
      if (history.canUndo || !this.#dialog.open) return;
      await this.#while(texts.mask.looking, async () => {
        if (typeof mask === "number") this.#document.fill(mask);
        else if (mask instanceof File) await this.#load(mask);
        else await this.#take(mask);
      });
      history.forget();
      this.#tell();
    } catch (error) {
      sayError(this.#words, error);
    }
  }

  async #automatic(): Promise<void> {
    await this.#while(texts.mask.looking, async () => {
      const mask = await this.#input.automatic();
      if (!mask) throw new Error(texts.mask.noAutomatic);
      await this.#take(mask);
    });
  }

  async #operate(operation: Operation): Promise<void> {
    await this.#while(texts.mask.working, () => this.#document.operate(operation));
  }

  async #take(mask: ObjectMask): Promise<void> {
    const { width, height } = this.#document.tiles;
    await this.#document.take(scaled(mask, width, height));
  }

  async #load(file: File): Promise<void> {
    const { width, height } = this.#document.tiles;
    await this.#document.take(await this.#work.do("decode", { file, width, height }));
  }

  /** Does something heavy: nothing is painted meanwhile, and a failure is said. */
  async #while(words: string, work: () => Promise<unknown>): Promise<void> {
    this.#busy += 1;
    this.#stage.locked = true;
    // Short work needs no words, they would only flicker.
    const patience = setTimeout(() => this.#say(words), 200);
    let problem: unknown;
    try {
      await work();
    } catch (error) {
      problem = error;
    }
    clearTimeout(patience);
    this.#busy -= 1;
    this.#stage.locked = this.#busy > 0;
    this.#tell();
    if (problem) sayError(this.#words, problem);
  }

  /** Says how much is inside, soon: counting keeps no stroke waiting. */
  #tell(): void {
    const { history, tiles } = this.#document;
    this.#undo.disabled = !history.canUndo;
    this.#redo.disabled = !history.canRedo;
    // A button that is no longer of use would take the focus with it, and the keys would go nowhere.
    if (document.activeElement instanceof HTMLButtonElement && document.activeElement.disabled)
      this.#stage.element.focus({ preventScroll: true });
    clearTimeout(this.#counting);
    this.#counting = setTimeout(() => {
      const pixels = tiles.count();
      this.#done.disabled = pixels === 0;
      if (this.#busy === 0) this.#say(texts.mask.inside(pixels, tiles.width, tiles.height));
    }, 120);
  }

  #say(words: string): void {
    this.#words.textContent = words;
  }

  #key(event: KeyboardEvent): void {
    if (event.target instanceof HTMLInputElement && event.target.type === "number") return;
    if (event.ctrlKey || event.metaKey) {
      const key = event.key.toLowerCase();
      if (this.#busy > 0 || (key !== "z" && key !== "y")) return;
      if (key === "y" || event.shiftKey) this.#document.redo();
      else this.#document.undo();
      event.preventDefault();
      return;
    }
    const tool = Object.entries(TOOLS).find(([, key]) => key === event.key)?.[0];
    if (tool) this.#panel.tools.choose(tool as keyof typeof TOOLS);
    else if (event.key === "[" || event.key === "]") this.#panel.resize(event.key === "[" ? -1 : 1);
    else if (event.key === "+" || event.key === "=") this.#view.zoom(1.4);
    else if (event.key === "-") this.#view.zoom(1 / 1.4);
    else if (event.key === "0") this.#view.fit();
    else if (event.key === "1") this.#view.zoom(1 / this.#view.scale);
  }

  /** Whether Escape would throw away work, which is said the first time. */
  #warns(): boolean {
    if (this.#warned || !this.#document.history.canUndo) return false;
    this.#warned = true;
    this.#say(texts.mask.leaving);
    return true;
  }

  async #finish(): Promise<void> {
    const { width, height } = this.#document.tiles;
    await this.#while(texts.mask.writing, async () => {
      const mask = await this.#document.whole();
      const png = await this.#work.do("encode", { mask, width, height }, [mask.buffer]);
      this.#close(new File([png], "mask.png", { type: "image/png" }));
    });
  }

  #close(file?: File): void {
    clearTimeout(this.#counting);
    this.#view.close();
    this.#dialog.close();
    this.#dialog.remove();
    this.#end(file);
  }
}
