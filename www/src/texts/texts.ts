import { en } from "./en/index.js";
import { language } from "./language.js";

/** What every language has: a room of the page each, words or functions that make words. */
export type Texts = typeof en;

/** The words of the page in its language. English comes with the page, the others when they are wanted. */
export const texts: Texts = language === "de" ? (await import("./de/index.js")).de : en;
