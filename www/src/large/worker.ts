import type { Shrunk, ToShrink } from "./shrink.js";

/** The part of a worker's global scope that is used here. */
interface Scope {
  postMessage(message: Shrunk): void;
  addEventListener(type: "message", listener: (event: MessageEvent<ToShrink>) => void): void;
}

const scope = self as unknown as Scope;

scope.addEventListener("message", async ({ data }) => {
  try {
    scope.postMessage({ png: await smaller(data) });
  } catch (error) {
    scope.postMessage({ problem: error instanceof Error ? error.message : String(error) });
  }
});

/** A picture with shorter sides, each pixel the mean of those that it stands for, as far as the browser takes it so. */
async function smaller({ file, times }: ToShrink): Promise<Blob> {
  const whole = await createImageBitmap(file, { premultiplyAlpha: "none" });
  const [width, height] = [Math.round(whole.width / times), Math.round(whole.height / times)];
  const bitmap = await createImageBitmap(whole, {
    premultiplyAlpha: "none",
    resizeWidth: Math.max(width, 1),
    resizeHeight: Math.max(height, 1),
    resizeQuality: "high",
  });
  whole.close();
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const drawing = canvas.getContext("2d");
  if (drawing === null) throw new Error("this browser cannot draw");
  drawing.drawImage(bitmap, 0, 0);
  bitmap.close();
  return await canvas.convertToBlob({ type: "image/png" });
}
