import type { Engine } from "../engine.js";
import { texts } from "../texts/texts.js";

/** What is known of a photograph before it is read. */
export interface About {
  readonly width: number;
  readonly height: number;
  readonly channels: number;
  readonly bytes: number;
  /** Why the page cannot make it smaller; empty when it can. */
  readonly fixed: string;
}

/** Longer side of photographs that only the estimator decodes: as large as they are. */
const WHOLE = 65_535;

/** What a photograph is. */
export async function aboutPhotograph(file: File, engine: Engine): Promise<About> {
  const head = new DataView(await file.slice(0, 32).arrayBuffer());
  const isPng = head.byteLength === 32 && head.getUint32(0) === 0x89504e47;
  if (isPng) {
    const deep = head.getUint8(24) === 16;
    const fixed = deep ? texts.large.fixed.deep : "";
    const channels = head.getUint8(25) % 4 === 0 ? 1 : 3;
    return { width: head.getUint32(16), height: head.getUint32(20), channels, bytes: deep ? 2 : 1, fixed };
  }
  try {
    const bitmap = await createImageBitmap(file);
    const { width, height } = bitmap;
    bitmap.close();
    return { width, height, channels: 3, bytes: 1, fixed: "" };
  } catch {
    const { width, height } = await engine.with((normalight) => normalight.thumbnail(file, { side: WHOLE }));
    // Such formats mostly have 16 bits.
    return { width, height, channels: 3, bytes: 2, fixed: texts.large.fixed.undecoded };
  }
}
