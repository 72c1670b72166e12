import type { Texts } from "../texts.js";

/** All words of the page in German. */
export const de: Texts = {};
