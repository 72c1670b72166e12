/** The languages of the page, each by its own name. */
export const LANGUAGES = { en: "English", de: "Deutsch" } as const;

export type Language = keyof typeof LANGUAGES;

/** Where the choice of the user is kept. */
const KEY = "language";

function isLanguage(name: string | null): name is Language {
  return name !== null && Object.hasOwn(LANGUAGES, name);
}

function kept(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    // Where nothing may be stored, the browser's languages decide.
    return null;
  }
}

/** The language of the page: the user's choice, or the first of the browser's that the page knows. */
function find(): Language {
  // The build, and tests of single modules, have no page.
  if (typeof document === "undefined") return "en";
  const chosen = kept();
  if (isLanguage(chosen)) return chosen;
  const known = navigator.languages.map((name) => name.slice(0, 2).toLowerCase()).find(isLanguage);
  return known ?? "en";
}

export const language = find();

/** Chooses a language, which counts once the page is loaded again. */
export function chooseLanguage(chosen: Language): void {
  localStorage.setItem(KEY, chosen);
}
