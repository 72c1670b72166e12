import { texts } from "../texts/texts.js";

/** Shares of the width that one press of a key moves the divider. */
const STEP = 0.02;

/** The divider between two maps, which can be dragged and moved by keys. */
export class Split {
  /** Where it is, as a share of the width. */
  at = 0.5;

  constructor(
    private readonly handle: HTMLElement,
    private readonly moved: () => void,
  ) {
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      event.preventDefault();
      handle.focus({ preventScroll: true });
    });
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const { left, width } = handle.parentElement?.getBoundingClientRect() ?? { left: 0, width: 1 };
      this.#move((event.clientX - left) / width);
    });
    handle.addEventListener("keydown", (event) => {
      const to = {
        ArrowLeft: this.at - STEP,
        ArrowRight: this.at + STEP,
        PageDown: this.at - 5 * STEP,
        PageUp: this.at + 5 * STEP,
        Home: 0,
        End: 1,
      }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      this.#move(to);
    });
  }

  /** Shows it between two maps, or hides it. */
  show(shown: boolean, left: string, right: string): void {
    this.handle.hidden = !shown;
    this.handle.setAttribute("aria-label", texts.viewer.divider(left, right));
    this.#say();
  }

  #move(to: number): void {
    this.at = Math.min(Math.max(to, 0), 1);
    this.#say();
    this.moved();
  }

  #say(): void {
    const percent = Math.round(100 * this.at);
    this.handle.setAttribute("aria-valuenow", String(percent));
    this.handle.setAttribute("aria-valuetext", texts.viewer.dividerAt(percent));
    this.handle.style.left = `${100 * this.at}%`;
  }
}
