import { en } from "./en/index.js";
import { type Language, language } from "./language.js";

/** What every language has: a room of the page each, words or functions that make words. */
export type Texts = typeof en;

/** English comes with the page, the others when they are wanted; they import nothing that imports this, which waits for them. */
const OTHERS: Record<Exclude<Language, "en">, () => Promise<Texts>> = {
  de: async () => (await import("./de/index.js")).de,
};

/** The words of the page in its language. */
export const texts: Texts = language === "en" ? en : await OTHERS[language]();
