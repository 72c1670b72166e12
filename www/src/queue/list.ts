import { byId, make, say, sayError, sayReason } from "../dom.js";
import { takenWords } from "../large/taken.js";
import { texts } from "../texts/texts.js";
import type { State } from "./state.js";

/** The stacks of a queue as people see them. */
export class QueueList {
  readonly #section = byId("queue");
  readonly #list = byId("queue-list");
  readonly #words = byId("queue-words");
  readonly #problem = byId("queue-problem");
  readonly #zip = byId<HTMLButtonElement>("queue-zip");
  readonly #forget = byId<HTMLButtonElement>("queue-forget");
  #buttons: (HTMLButtonElement | undefined)[] = [];

  constructor(private readonly asked: { show(index: number): void; zip(): void; forget(): void }) {
    this.#zip.addEventListener("click", () => asked.zip());
    this.#forget.addEventListener("click", () => asked.forget());
  }

  /** Shows stacks that wait. */
  begin(names: readonly string[]): void {
    this.#buttons = [];
    this.#section.hidden = false;
    this.#list.replaceChildren(
      ...names.map((name) => make("li", "", make("b", "", name), stateWords({ kind: "waiting" }))),
    );
    this.#zip.disabled = true;
    this.#forget.disabled = true;
    this.fail();
  }

  /** Says how far a stack is. */
  tell(index: number, state: State): void {
    const item = this.#list.children[index];
    if (!(item instanceof HTMLElement)) return;
    item.dataset.state = state.kind;
    const name = item.firstElementChild?.textContent ?? "";
    const said = stateWords(state);
    if (state.kind !== "done") {
      item.replaceChildren(make("b", "", name), said);
      return;
    }
    const button = make("button", "", name);
    button.type = "button";
    button.title = texts.queue.show;
    button.setAttribute("aria-pressed", "false");
    button.addEventListener("click", () => this.asked.show(index));
    this.#buttons[index] = button;
    this.#zip.disabled = false;
    item.replaceChildren(button, said);
  }

  /** Says how it is with all of them. */
  say(words: string): void {
    this.#words.textContent = words;
  }

  /** Says what went wrong with the list itself. */
  fail(error?: unknown): void {
    if (error === undefined) say(this.#problem, "");
    else sayError(this.#problem, error);
  }

  /** The queue has come to its end. */
  end(): void {
    this.#forget.disabled = false;
  }

  /** Which result is shown, if it is one of these. */
  mark(index: number | undefined): void {
    for (const [at, button] of this.#buttons.entries())
      button?.setAttribute("aria-pressed", String(at === index));
  }

  /** While the archive is made, it cannot be asked for again. */
  set packing(packing: boolean) {
    this.#zip.disabled = packing;
  }

  close(): void {
    this.#section.hidden = true;
    this.#list.replaceChildren();
  }
}

function stateWords(state: State): HTMLElement {
  const said = make("span");
  if (state.kind === "failed") sayReason(said, state.reason, texts.queue.failed);
  else if (state.kind === "done") {
    const { photographs, width, height, seconds, taken } = state.facts;
    said.textContent = texts.queue.done(photographs, width, height, takenWords(taken), seconds);
  } else said.textContent = texts.queue.states[state.kind];
  return said;
}
