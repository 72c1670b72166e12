import { wholeOf } from "../crop/rectangle.js";
import { Average } from "./average.js";
import type { TakenPicture, ToTake } from "./shrink.js";
import { sideOf } from "./side.js";

/** The part of a worker's global scope that is used here. */
interface Scope {
  postMessage(message: TakenPicture): void;
  addEventListener(type: "message", listener: (event: MessageEvent<ToTake>) => void): void;
}

const scope = self as unknown as Scope;

/** Rows that are read at once: a copy of all would take as much memory again as the picture. */
const ROWS = 128;

scope.addEventListener("message", async ({ data }) => {
  try {
    scope.postMessage(await take(data));
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    scope.postMessage({ problem: { kind: "broken", message } });
  }
});

/** A part of a picture, with shorter sides. */
async function take({ file, taken: { times, crop, frame }, linear }: ToTake): Promise<TakenPicture> {
  const whole = await createImageBitmap(file, { premultiplyAlpha: "none" });
  const { width, height } = whole;
  // In a photograph of another size the same rectangle would be another part of the object.
  if (crop && frame && (frame.width !== width || frame.height !== height))
    return { problem: { kind: "other-size", own: { width, height }, others: frame } };
  const part = crop ?? wholeOf(whole);
  const [toWidth, toHeight] = [sideOf(part.width, times), sideOf(part.height, times)];
  const canvas = new OffscreenCanvas(toWidth, toHeight);
  const drawing = contextOf(canvas);
  if (!drawing) return { problem: { kind: "no-drawing" } };
  if (times === 1) drawing.drawImage(whole, -part.left, -part.top);
  else {
    const average = new Average(part.width, part.height, toWidth, toHeight, linear);
    const strip = contextOf(new OffscreenCanvas(part.width, Math.min(ROWS, part.height)));
    if (!strip) return { problem: { kind: "no-drawing" } };
    for (let top = 0; top < part.height; top += ROWS) {
      const rows = Math.min(ROWS, part.height - top);
      strip.clearRect(0, 0, part.width, rows);
      strip.drawImage(whole, -part.left, -part.top - top);
      average.add(strip.getImageData(0, 0, part.width, rows).data);
    }
    drawing.putImageData(new ImageData(average.pixels, toWidth, toHeight), 0, 0);
  }
  whole.close();
  return { png: await canvas.convertToBlob({ type: "image/png" }) };
}

function contextOf(canvas: OffscreenCanvas): OffscreenCanvasRenderingContext2D | null {
  // Pixels are read and written: drawn by the processor, none of them must come back from a GPU.
  return canvas.getContext("2d", { willReadFrequently: true });
}
