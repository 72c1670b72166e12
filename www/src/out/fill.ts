/** Puts texts in the places of a template: `{{name}}`, and in scripts and styles a comment of such a kind. */
export function fill(page: string, texts: Readonly<Record<string, string>>): string {
  return page.replace(
    /\/\*\{(\w+)\}\*\/|\{\{(\w+)\}\}/g,
    (whole: string, first?: string, second?: string) => texts[first ?? second ?? ""] ?? whole,
  );
}

/** Words as they may stand in a page. */
export function escaped(words: string): string {
  return words.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
}
