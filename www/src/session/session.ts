import { byId, say, sayError } from "../dom.js";
import type { Hand } from "../lights/hand.js";
import type { Term } from "../queue/state.js";
import type { Outcome } from "../result.js";
import type { KeptSettings } from "../settings.js";
import { texts } from "../texts/texts.js";
import type { Bench, KeptOutcome, KeptStack, Part, StoredQueue } from "./bench.js";
import { SessionKeeper } from "./keeper.js";
import { unpack } from "./pack.js";
import { SessionStore } from "./store.js";

/** What the session needs of the page. */
export interface SessionPage {
  bench(): Bench;
  /** Puts what was kept on the bench. */
  restore(bench: Bench): void;
  /** For how long the queue is kept. */
  keptQueue(term: Exclude<Term, "memory">): void;
  /** Nothing of the last session is kept any more. */
  cleared(): void;
}

/** Under this name a window knows that it loads itself again, and that nothing is to be asked then. */
const AGAIN = "normalight.again";

/** The session of this browser: what is on the bench is kept, and offered after a reload or a crash. */
export class Session {
  readonly #page: SessionPage;
  readonly #store: SessionStore;
  readonly #keeper: SessionKeeper;
  readonly #offer = byId("session");
  readonly #problem = byId("session-problem");

  constructor(page: SessionPage) {
    this.#page = page;
    this.#store = new SessionStore(page.cleared);
    this.#keeper = new SessionKeeper(
      this.#store,
      page.bench,
      (words) => say(byId("stack-kept"), words),
      page.keptQueue,
    );
    byId("session-forget").addEventListener("click", () => void this.#forget());
    byId("session-restore").addEventListener("click", () => void this.#restore());
    void this.#store.granted.then(() => this.#find());
  }

  /** A stack was begun: whoever begins anew has answered the offer. */
  begun(): void {
    this.#offer.hidden = true;
    say(this.#problem, "");
  }

  /** A part of the bench has changed. */
  changed(part: Part): void {
    this.#keeper.changed(part);
  }

  /**
   * Keeps everything for a reload that the page begins itself; whether all of it is kept.
   *
   * @param others tells whether what it does not know of is kept, too
   */
  async keep(others: () => boolean): Promise<boolean> {
    const kept = (await this.#keeper.settled()) && others();
    if (kept && this.#page.bench().files.length > 0) sessionStorage.setItem(AGAIN, "true");
    return kept;
  }

  /** Offers what the last visit left; nothing is put back unasked, but where the page has loaded itself again. */
  async #find(): Promise<void> {
    try {
      const stack = await this.#store.get<KeptStack>("stack");
      if (this.#page.bench().files.length > 0) {
        // Another window had its session until now.
        this.#keeper.changed("stack");
        return;
      }
      if (!stack) return;
      if (sessionStorage.getItem(AGAIN)) {
        sessionStorage.removeItem(AGAIN);
        await this.#putBack();
        return;
      }
      const { name, photographs, time } = stack;
      byId("session-words").textContent = texts.session.goOn(name, photographs, time);
      this.#offer.hidden = false;
    } catch {
      // A browser that keeps nothing has nothing to offer; it says so when there is something to keep.
    }
  }

  async #forget(): Promise<void> {
    this.#leave();
    say(this.#problem, "");
    try {
      await this.#store.clear();
    } catch (error) {
      sayError(this.#problem, error, texts.session.stillKept);
    }
  }

  async #restore(): Promise<void> {
    this.#leave();
    await this.#putBack();
  }

  async #putBack(): Promise<void> {
    try {
      const [stack, settings, outcome, hand, queue] = (await this.#store.getMany<unknown>([
        "stack",
        "settings",
        "outcome",
        "hand",
        "queue",
      ])) as [KeptStack, KeptSettings, KeptOutcome | undefined, Hand | undefined, StoredQueue | undefined];
      const ofOutcome = [...(outcome?.files ?? []), ...(outcome?.used ?? [])];
      const ofQueue = queue?.stacks.flatMap(({ result }) => result?.files ?? []) ?? [];
      const files = await this.#files([...new Set([...stack.files, ...ofOutcome, ...ofQueue])]);
      const listed = (parts: readonly string[]) => parts.flatMap((part) => files.get(part) ?? []);
      const { name, photographs, crop } = stack;
      const shown = outcome && {
        ...outcome,
        estimate: (await unpack(outcome.estimate)) as Outcome["estimate"],
        files: listed(outcome.files),
        used: listed(outcome.used),
      };
      const stacks = queue?.stacks.map(({ result, ...one }) => ({
        ...one,
        result: result && { ...result, files: listed(result.files), used: listed(result.used) },
      }));
      // Other files were taken meanwhile: those count.
      if (this.#page.bench().files.length > 0) return;
      this.#keeper.adopt(stack, ofOutcome, ofQueue, files);
      const kept = { name, photographs, files: listed(stack.files), crop };
      this.#page.restore({
        ...kept,
        settings,
        outcome: shown,
        hand,
        queue: queue && stacks && { ...queue, stacks },
      });
      say(this.#problem, "");
    } catch (error) {
      sayError(this.#problem, error, texts.session.unread);
    }
  }

  async #files(parts: readonly string[]): Promise<Map<string, File>> {
    const files = await this.#store.getMany<File>(parts);
    if (files.some((file) => !(file instanceof File))) throw new Error(texts.session.missing);
    return new Map(parts.map((part, index) => [part, files[index] as File]));
  }

  /** The offer is answered; the focus would be lost with it. */
  #leave(): void {
    this.#offer.hidden = true;
    byId("pick-files").focus();
  }
}
