import { language } from "./language.js";
import { texts } from "./texts.js";

/** Gives the page its language. It comes in English, with names for its words beside them (`plugins/texts.js`). */
export function translatePage(): void {
  if (language === "en") return;
  document.documentElement.lang = language;
  for (const element of document.querySelectorAll<HTMLElement>("[data-text]"))
    element.textContent = wordsAt(element.dataset.text ?? "");
  for (const element of document.querySelectorAll<HTMLElement>("[data-text-attributes]")) {
    for (const pair of element.dataset.textAttributes?.split("; ") ?? []) {
      const [attribute = "", key = ""] = pair.split(":");
      element.setAttribute(attribute, wordsAt(key));
    }
  }
}

/** The words of a key, `room.key`; the build has looked that they are there. */
function wordsAt(key: string): string {
  return String(key.split(".").reduce<unknown>((part, name) => Object(part)[name], texts));
}
