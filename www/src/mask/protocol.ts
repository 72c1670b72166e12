import type { Frame } from "../crop/rectangle.js";

/** A photograph as the editor shows it. */
export interface Picture {
  readonly width: number;
  readonly height: number;
  /** The picture in full and in halves of it: each level is drawn where it is about as large as the screen shows it. */
  readonly levels: readonly ImageBitmap[];
  /** Whether it is so dark that it is shown lightened: values that are proportional to light. */
  readonly dark: boolean;
}

/** What is done with a whole mask. */
export type Operation =
  | { readonly kind: "grow" | "shrink"; readonly radius: number }
  | { readonly kind: "holes" | "invert" }
  | { readonly kind: "threshold"; readonly level: number; readonly brighter: boolean };

/** RGBA pixels of a picture that the browser does not decode. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly rgba: Uint8Array<ArrayBuffer>;
}

/** What the editor's worker does: heavy work that must not keep a stroke waiting. */
export interface MaskTasks {
  /** Decodes a photograph and keeps its brightness. */
  open: { request: Blob | Pixels; response: Picture };
  /** Decodes a mask in the frame of the photograph. */
  decode: { request: { file: Blob; width: number; height: number }; response: Uint8Array<ArrayBuffer> };
  operate: {
    request: { mask: Uint8Array<ArrayBuffer>; width: number; height: number; operation: Operation };
    response: Uint8Array<ArrayBuffer>;
  };
  encode: { request: { mask: Uint8Array<ArrayBuffer>; width: number; height: number }; response: Blob };
}

export type MaskTask = keyof MaskTasks;

/** What went wrong in the worker: the page has words for it, or they are the browser's. */
export type Problem =
  | { readonly kind: "shape"; readonly mask: Frame; readonly photograph: Frame }
  | { readonly kind: "canvas" }
  | { readonly kind: "other"; readonly words: string };

export interface ToMaskWorker<T extends MaskTask = MaskTask> {
  readonly id: number;
  readonly task: T;
  readonly request: MaskTasks[T]["request"];
}

export type FromMaskWorker =
  | { readonly id: number; readonly response: MaskTasks[MaskTask]["response"] }
  | { readonly id: number; readonly problem: Problem };
