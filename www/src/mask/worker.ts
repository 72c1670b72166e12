import { fillHoles, grow, invert, shrink, threshold } from "./operations.js";
import { greyPng } from "./png.js";
import type {
  FromMaskWorker,
  MaskTask,
  MaskTasks,
  Operation,
  Picture,
  Pixels,
  Problem,
  ToMaskWorker,
} from "./protocol.js";

/** The part of a worker's global scope that is used here. */
interface Scope {
  postMessage(message: FromMaskWorker, transfer: Transferable[]): void;
  addEventListener(type: "message", listener: (event: MessageEvent<ToMaskWorker>) => void): void;
}

const scope = self as unknown as Scope;

/** Rows that are read from a canvas at once. */
const ROWS = 256;
/** A level of this size or smaller is the last. */
const SMALLEST = 1500;

/** Brightness of the photograph that was opened last. */
let grey = new Uint8Array(0);

/** Something that the page has words for. */
class Failure extends Error {
  constructor(readonly problem: Problem) {
    super(problem.kind);
  }
}

scope.addEventListener("message", async ({ data: { id, task, request } }) => {
  try {
    const response = await perform(task, request);
    scope.postMessage({ id, response }, transferable(response));
  } catch (error) {
    scope.postMessage({ id, problem: problemOf(error) }, []);
  }
});

function problemOf(error: unknown): Problem {
  if (error instanceof Failure) return error.problem;
  return { kind: "other", words: error instanceof Error ? error.message : String(error) };
}

function perform(task: MaskTask, request: unknown): Promise<MaskTasks[MaskTask]["response"]> {
  switch (task) {
    case "open":
      return open(request as MaskTasks["open"]["request"]);
    case "decode":
      return decode(request as MaskTasks["decode"]["request"]);
    case "operate": {
      const { mask, width, height, operation } = request as MaskTasks["operate"]["request"];
      return Promise.resolve(operate(mask, width, height, operation));
    }
    case "encode": {
      const { mask, width, height } = request as MaskTasks["encode"]["request"];
      return greyPng(mask, width, height);
    }
  }
}

async function open(picture: Blob | Pixels): Promise<Picture> {
  const whole = await createImageBitmap(
    picture instanceof Blob
      ? picture
      : new ImageData(new Uint8ClampedArray(picture.rgba.buffer), picture.width, picture.height),
  );
  const { width, height } = whole;
  grey = brightness(whole, width, height);
  const levels = [whole];
  for (let [last, side] = [whole, Math.max(width, height) / 2]; side > SMALLEST; side /= 2) {
    const share = side / Math.max(width, height);
    last = await createImageBitmap(last, {
      resizeWidth: Math.max(Math.round(width * share), 1),
      resizeHeight: Math.max(Math.round(height * share), 1),
      resizeQuality: "medium",
    });
    levels.push(last);
  }
  return { width, height, levels, dark: isDark(grey) };
}

/** A mask file; one that is larger or smaller than the photograph is brought to its size. */
async function decode({
  file,
  width,
  height,
}: MaskTasks["decode"]["request"]): Promise<Uint8Array<ArrayBuffer>> {
  const bitmap = await createImageBitmap(file);
  const shape = bitmap.width / bitmap.height / (width / height);
  if (shape < 0.98 || shape > 1.02)
    throw new Failure({
      kind: "shape",
      mask: { width: bitmap.width, height: bitmap.height },
      photograph: { width, height },
    });
  return threshold(brightness(bitmap, width, height), 128, true);
}

function operate(
  mask: Uint8Array,
  width: number,
  height: number,
  operation: Operation,
): Uint8Array<ArrayBuffer> {
  switch (operation.kind) {
    case "grow":
      return grow(mask, width, height, operation.radius);
    case "shrink":
      return shrink(mask, width, height, operation.radius);
    case "holes":
      return fillHoles(mask, width, height);
    case "invert":
      return invert(mask);
    case "threshold":
      return threshold(grey, operation.level, operation.brighter);
  }
}

/** Brightness of a picture's pixels as stored, some rows at a time: a copy of all would take four times as much. */
function brightness(picture: ImageBitmap, width: number, height: number): Uint8Array<ArrayBuffer> {
  const canvas = new OffscreenCanvas(width, Math.min(ROWS, height));
  const drawing = canvas.getContext("2d", { willReadFrequently: true });
  if (drawing === null) throw new Failure({ kind: "canvas" });
  drawing.imageSmoothingEnabled = false;
  const values = new Uint8Array(width * height);
  for (let top = 0; top < height; top += ROWS) {
    const rows = Math.min(ROWS, height - top);
    drawing.clearRect(0, 0, width, ROWS);
    drawing.drawImage(picture, 0, -top, width, height);
    const { data } = drawing.getImageData(0, 0, width, rows);
    for (let [from, to] = [0, top * width]; from < data.length; from += 4, to++)
      values[to] = (77 * (data[from] ?? 0) + 150 * (data[from + 1] ?? 0) + 29 * (data[from + 2] ?? 0)) >> 8;
  }
  return values;
}

/** Whether hardly any pixel is bright. */
function isDark(values: Uint8Array): boolean {
  const bright = values.reduce((sum, value) => (value > 110 ? sum + 1 : sum), 0);
  return bright < values.length / 50;
}

function transferable(response: MaskTasks[MaskTask]["response"]): Transferable[] {
  if (response instanceof Uint8Array) return [response.buffer];
  return "levels" in response ? [...response.levels] : [];
}
