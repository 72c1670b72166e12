import { byId, say, sayError } from "./dom.js";
import { chooseLanguage, LANGUAGES, type Language, language } from "./texts/language.js";
import { texts } from "./texts/texts.js";

/** What the choice of a language needs of the page, which is loaded again for another one. */
export interface LanguagePage {
  /** Whether something is under way that ends with the page. */
  busy(): boolean;
  /** Keeps all that is on the page for the page that comes next; whether it can. */
  keep(): Promise<boolean>;
}

/** The choice of the language that the page speaks. */
export class LanguageChoice {
  readonly #select = byId<HTMLSelectElement>("language");
  readonly #words = byId("language-words");

  constructor(private readonly page: LanguagePage) {
    for (const [name, own] of Object.entries(LANGUAGES)) {
      const option = new Option(own, name, false, name === language);
      option.lang = name;
      this.#select.append(option);
    }
    this.#select.addEventListener("change", () => void this.#choose(this.#select.value as Language));
  }

  async #choose(chosen: Language): Promise<void> {
    say(this.#words, "");
    if (this.page.busy()) {
      this.#select.value = language;
      say(this.#words, texts.run.underWay);
      return;
    }
    try {
      chooseLanguage(chosen);
    } catch (error) {
      this.#select.value = language;
      sayError(this.#words, error);
      return;
    }
    if (chosen === language) return;
    if (await this.page.keep()) location.reload();
    else say(this.#words, texts.top.languageLater);
  }
}
