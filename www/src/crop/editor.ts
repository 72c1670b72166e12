import { context, make } from "../dom.js";
import { button, group, row } from "../mask/toolbar.js";
import { texts } from "../texts/texts.js";
import { type Crop, type Frame, isWhole, SHORTEST, typed, wholeOf } from "./rectangle.js";
import { CropStage } from "./stage.js";

/** Longer side in pixels at which the photograph is shown at most. */
const SHOWN = 2000;

/** What somebody decided: a part of this frame, or none of it for all. */
export interface FramedCrop {
  readonly frame: Frame;
  readonly crop: Crop | undefined;
}

/** Lets people draw the part of a photograph that is taken; nothing when they leave it as it was. */
export async function editCrop(photograph: File, crop: Crop | undefined): Promise<FramedCrop | undefined> {
  const whole = await createImageBitmap(photograph);
  const frame = { width: whole.width, height: whole.height };
  const picture = make("canvas");
  const scale = Math.min(1, SHOWN / Math.max(frame.width, frame.height));
  picture.width = Math.max(Math.round(scale * frame.width), 1);
  picture.height = Math.max(Math.round(scale * frame.height), 1);
  const drawing = context(picture);
  drawing.imageSmoothingQuality = "high";
  drawing.drawImage(whole, 0, 0, picture.width, picture.height);
  whole.close();
  const edited = await new CropEditor(picture, frame, crop).edited;
  return edited && { frame, crop: isWhole(edited, frame) ? undefined : edited };
}

const NUMBERS: readonly (keyof Crop)[] = ["left", "top", "width", "height"];

class CropEditor {
  readonly edited: Promise<Crop | undefined>;
  readonly #frame: Frame;
  readonly #dialog = make("dialog", "mask-editor crop-editor");
  readonly #words = make("p", "mask-words");
  readonly #stage: CropStage;
  readonly #inputs = new Map<keyof Crop, HTMLInputElement>();
  #crop: Crop;
  #end: (crop: Crop | undefined) => void = () => {};

  constructor(picture: HTMLCanvasElement, frame: Frame, crop: Crop | undefined) {
    this.#frame = frame;
    this.#crop = crop ?? wholeOf(frame);
    this.#stage = new CropStage(picture, frame, (changed) => this.#show(changed));
    this.#build();
    this.#show(this.#crop);
    this.edited = new Promise((resolve) => {
      this.#end = resolve;
    });
    document.body.append(this.#dialog);
    this.#dialog.showModal();
    this.#stage.box.focus();
  }

  #build(): void {
    const title = make("h2", "", texts.crop.title);
    title.id = "crop-title";
    this.#dialog.setAttribute("aria-labelledby", title.id);
    this.#words.setAttribute("role", "status");
    // Width before height, also where a page begins at the right.
    this.#words.dir = "auto";
    const done = button("done", texts.crop.done, texts.crop.doneTitle, () => this.#close(this.#crop));
    done.classList.add("accent");
    const buttons = row(
      button("cancel", texts.crop.cancel, texts.crop.cancelTitle, () => this.#close()),
      done,
    );
    const head = make("header", "mask-head", title, this.#words, buttons);
    this.#dialog.append(head, make("div", "mask-body", this.#stage.element, this.#panel()));
    this.#dialog.addEventListener("cancel", () => this.#close());
  }

  #panel(): HTMLElement {
    const numbers = NUMBERS.map((name) =>
      make("label", "crop-number", texts.crop.numbers[name], this.#input(name)),
    );
    const whole = button("frame", texts.crop.whole, texts.crop.wholeTitle, () =>
      this.#show(wholeOf(this.#frame)),
    );
    const keys = make("p", "notice", texts.crop.keys);
    keys.id = "crop-keys";
    this.#stage.box.setAttribute("aria-describedby", keys.id);
    return make(
      "div",
      "mask-panel",
      group(texts.crop.inPixels, make("div", "crop-numbers", ...numbers), row(whole)),
      keys,
    );
  }

  #input(name: keyof Crop): HTMLInputElement {
    const { width, height } = this.#frame;
    const most = name === "left" || name === "width" ? width : height;
    const isLength = name === "width" || name === "height";
    const input = make("input");
    Object.assign(input, {
      type: "number",
      name: `crop-${name}`,
      min: String(isLength ? SHORTEST : 0),
      max: String(isLength ? most : most - SHORTEST),
    });
    input.addEventListener("change", () =>
      this.#show(typed(this.#crop, name, input.valueAsNumber, this.#frame)),
    );
    this.#inputs.set(name, input);
    return input;
  }

  #show(crop: Crop): void {
    this.#crop = crop;
    this.#stage.crop = crop;
    for (const [name, input] of this.#inputs) input.value = String(crop[name]);
    this.#words.textContent = isWhole(crop, this.#frame)
      ? texts.crop.wholeFrame(crop)
      : texts.crop.rectangle(crop);
  }

  #close(crop?: Crop): void {
    this.#stage.close();
    this.#dialog.close();
    this.#dialog.remove();
    this.#end(crop);
  }
}
