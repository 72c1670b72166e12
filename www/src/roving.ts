/**
 * Makes the controls of a list one stop of the tab key: arrow keys, Home and End move within it, so that ninety-six
 * thumbnails do not stand between two buttons.
 */
export class Roving {
  readonly #list: HTMLElement;
  readonly #selector: string;

  /** @param selector which elements in the list are the controls */
  constructor(list: HTMLElement, selector: string) {
    this.#list = list;
    this.#selector = selector;
    list.addEventListener("focusin", ({ target }) => {
      if (target instanceof HTMLElement && target.matches(selector)) this.#stopAt(target);
    });
    list.addEventListener("keydown", (event) => this.#key(event));
  }

  get controls(): HTMLElement[] {
    return [...this.#list.querySelectorAll<HTMLElement>(this.#selector)];
  }

  /** The list's content has changed. */
  update(): void {
    const { controls } = this;
    this.#stopAt(controls.find(({ tabIndex }) => tabIndex === 0) ?? controls[0]);
  }

  #stopAt(stop: HTMLElement | undefined): void {
    for (const control of this.controls) control.tabIndex = control === stop ? 0 : -1;
  }

  #key(event: KeyboardEvent): void {
    const { controls } = this;
    const at = controls.indexOf(event.target as HTMLElement);
    if (at < 0 || event.ctrlKey || event.altKey || event.metaKey) return;
    const next = this.#next(event.key, at, controls);
    if (next === undefined) return;
    event.preventDefault();
    controls[Math.min(Math.max(next, 0), controls.length - 1)]?.focus();
  }

  #next(key: string, at: number, controls: readonly HTMLElement[]): number | undefined {
    // Right is onwards, except where people read from the right.
    const onwards = getComputedStyle(this.#list).direction === "rtl" ? -1 : 1;
    switch (key) {
      case "ArrowRight":
        return at + onwards;
      case "ArrowLeft":
        return at - onwards;
      case "ArrowDown":
        return at + columnsOf(controls);
      case "ArrowUp":
        return at - columnsOf(controls);
      case "Home":
        return 0;
      case "End":
        return controls.length - 1;
      default:
        return undefined;
    }
  }
}

/** How many controls lie side by side in the first row. */
function columnsOf(controls: readonly HTMLElement[]): number {
  const top = controls[0]?.getBoundingClientRect().top ?? 0;
  const below = controls.findIndex((control) => control.getBoundingClientRect().top > top + 2);
  return below < 0 ? controls.length : below;
}
