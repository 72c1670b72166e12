import { wordsOf } from "../dom.js";
import type { KeptQueue, Term } from "../queue/state.js";
import type { Outcome } from "../result.js";
import { fixed } from "../texts/numbers.js";
import { texts } from "../texts/texts.js";
import {
  type Bench,
  type KeptOutcome,
  type KeptStack,
  LARGEST,
  type Part,
  type StoredQueue,
} from "./bench.js";
import { largeBytes, pack } from "./pack.js";
import { room, type SessionStore } from "./store.js";

/** Milliseconds that changes are gathered before they are written. */
const DELAY = 250;

/** Writes what is on the bench into this browser, file by file, as it changes; one session, never several. */
export class SessionKeeper {
  /** Parts that hold files, by the files. */
  readonly #names = new Map<File, string>();
  readonly #changed = new Set<Part>();
  /** The stack that is kept. */
  #time = 0;
  #stack: readonly string[] = [];
  #outcome: readonly string[] = [];
  #queue: readonly string[] = [];
  /** The result that is kept. */
  #shown: Outcome | undefined;
  #saving: Promise<void> | undefined;
  /** Why this stack is not kept. */
  #failed = false;

  /**
   * @param bench tells what there is to keep
   * @param tell hears in words what became of it
   * @param keptQueue hears for how long the queue is kept
   */
  constructor(
    private readonly store: SessionStore,
    private readonly bench: () => Bench,
    private readonly tell: (words: string) => void,
    private readonly keptQueue: (term: Exclude<Term, "memory">) => void,
  ) {}

  /** A part of the bench has changed. */
  changed(part: Part): void {
    this.#changed.add(part);
    this.#saving ??= this.#save().finally(() => {
      this.#saving = undefined;
    });
  }

  /** Waits until everything is written; whether all that is on the bench is kept then. */
  async settled(): Promise<boolean> {
    while (this.#saving) await this.#saving;
    const { files, outcome } = this.bench();
    const stack = files.every((file) => this.#names.has(file));
    return stack && (outcome === undefined || outcome === this.#shown);
  }

  /** What was read from the browser is on the bench now, and its files need not be written again. */
  adopt(
    kept: KeptStack,
    outcome: readonly string[],
    queue: readonly string[],
    files: ReadonlyMap<string, File>,
  ): void {
    for (const [name, file] of files) this.#names.set(file, name);
    this.#time = kept.time;
    this.#stack = kept.files;
    this.#outcome = outcome;
    this.#queue = queue;
  }

  async #save(): Promise<void> {
    while (this.#changed.size > 0) {
      await new Promise((resolve) => setTimeout(resolve, DELAY));
      const parts = new Set(this.#changed);
      this.#changed.clear();
      try {
        await this.#write(parts);
      } catch (error) {
        await this.#giveUp(error);
      }
    }
  }

  async #write(parts: ReadonlySet<Part>): Promise<void> {
    const { files, settings, queue } = this.bench();
    if (this.#failed && !parts.has("stack")) return;
    const other = !files.some((file) => this.#names.has(file));
    if (other && this.#names.size + files.length > 0) {
      if (!this.store.owned) {
        this.tell(texts.session.otherWindow);
        return;
      }
      // Another stack, or none: nothing of the last one stays.
      [this.#stack, this.#outcome, this.#failed] = [[], [], false];
      this.#shown = undefined;
      this.#time = Date.now();
      this.tell("");
      if (files.length > 0 && queue && this.#queue.length > 0) {
        await this.store.delete("stack", "settings", "outcome", "hand");
        await this.#deleteOthers();
      } else await this.#clear();
    }
    if (files.length === 0) return;
    const wanted = (part: Part) => other || parts.has(part);
    if (wanted("stack") && !(await this.#writeStack())) {
      for (const part of parts) this.#changed.add(part);
      return;
    }
    if (wanted("settings")) await this.store.set("settings", settings);
    if (wanted("outcome")) await this.#writeOutcome();
    if (wanted("outcome") || wanted("hand")) await this.#writeHand();
    // With the result that is shown another one of the queue may be.
    if (wanted("queue") || wanted("outcome")) await this.#writeQueue();
  }

  /** Writes the stack; whether it is still the one on the bench afterwards. */
  async #writeStack(): Promise<boolean> {
    const { files, name, photographs, crop } = this.bench();
    const missing = files.filter((file) => !this.#names.has(file));
    const needed = bytesOf(missing);
    const free = await room();
    if (needed > free) throw new Error(texts.session.tooLarge(gigabytes(needed), gigabytes(free)));
    for (const file of missing) {
      // Other files came meanwhile: they are next.
      if (this.#changed.has("stack")) return false;
      await this.#writeFile(file);
    }
    this.#stack = this.#partsOf(files);
    // Last: what it names is there.
    await this.store.set("stack", {
      name,
      photographs,
      crop,
      time: this.#time,
      files: this.#stack,
    } satisfies KeptStack);
    await this.#deleteOthers();
    this.tell(texts.session.kept);
    return true;
  }

  async #writeFile(file: File): Promise<void> {
    const part = `file ${this.#time}-${this.#names.size}-${Math.random().toString(36).slice(2)}`;
    await this.store.set(part, file);
    this.#names.set(file, part);
  }

  async #writeOutcome(): Promise<void> {
    const { outcome } = this.bench();
    this.#shown = undefined;
    const most = Math.min(LARGEST, await room());
    if (!outcome || !this.#holds(outcome) || largeBytes(outcome.estimate) > most) {
      this.#outcome = [];
      await this.store.delete("outcome");
      return;
    }
    const { name, format, files, used, size, taken } = outcome;
    const estimate = await pack(outcome.estimate);
    // Photographs that were made smaller are files of their own.
    for (const file of used) if (!this.#names.has(file)) await this.#writeFile(file);
    const parts = { files: this.#partsOf(files), used: this.#partsOf(used) };
    this.#outcome = [...parts.files, ...parts.used];
    await this.store.set("outcome", { name, format, size, taken, estimate, ...parts } satisfies KeptOutcome);
    this.#shown = outcome;
    await this.#deleteOthers();
  }

  /** Lights as they are in the hand; those of another stack belong to nothing here. */
  async #writeHand(): Promise<void> {
    const { outcome, hand } = this.bench();
    if (outcome && hand && this.#holds(outcome)) await this.store.set("hand", hand);
    else await this.store.delete("hand");
  }

  /** The finished results of a queue with their photographs, where there is room for all of those. */
  async #writeQueue(): Promise<void> {
    const { queue } = this.bench();
    const written = queue !== undefined && (await this.#writeResults(queue).catch(() => false));
    if (!written) {
      this.#queue = [];
      await this.store.delete("queue");
    }
    await this.#deleteOthers();
    this.keptQueue(written ? "reload" : queue ? "no-room" : "page");
  }

  /** Writes their photographs, and where those lie; whether there was room. */
  async #writeResults({ stacks, ...queue }: KeptQueue): Promise<boolean> {
    const files = [...new Set(stacks.flatMap(({ result }) => result?.files ?? []))];
    const missing = files.filter((file) => !this.#names.has(file));
    if (bytesOf(missing) > (await room())) return false;
    for (const file of missing) await this.#writeFile(file);
    this.#queue = this.#partsOf(files);
    const stored = stacks.map(({ result, ...stack }) => {
      const parts = result && { files: this.#partsOf(result.files), used: this.#partsOf(result.used) };
      return { ...stack, result: result && parts && { ...result, ...parts } };
    });
    await this.store.set("queue", { ...queue, stacks: stored } satisfies StoredQueue);
    return true;
  }

  /** Whether the photographs of a result are all kept. */
  #holds({ files }: Outcome): boolean {
    return files.every((file) => this.#names.has(file));
  }

  /** Files that are neither in the stack nor in a result any more go. */
  async #deleteOthers(): Promise<void> {
    const needed = new Set([...this.#stack, ...this.#outcome, ...this.#queue]);
    const gone = [...this.#names].filter(([, part]) => !needed.has(part));
    for (const [file] of gone) this.#names.delete(file);
    if (gone.length > 0) await this.store.delete(...gone.map(([, part]) => part));
  }

  /** What cannot be kept whole is not kept at all; an estimate does not need it. */
  async #giveUp(error: unknown): Promise<void> {
    this.#failed = true;
    this.#shown = undefined;
    this.tell(texts.session.notKept(reason(error)));
    await this.#clear().catch(() => undefined);
  }

  async #clear(): Promise<void> {
    this.#names.clear();
    this.#queue = [];
    this.keptQueue("page");
    await this.store.clear();
  }

  #partsOf(files: readonly File[]): string[] {
    return files.flatMap((file) => this.#names.get(file) ?? []);
  }
}

function reason(error: unknown): string {
  if (error instanceof DOMException && error.name === "QuotaExceededError") return texts.session.full;
  return wordsOf(error).replace(/\.$/, "");
}

function bytesOf(files: readonly File[]): number {
  return files.reduce((sum, { size }) => sum + size, 0);
}

function gigabytes(bytes: number): string {
  return bytes < 1e9 ? `${Math.max(Math.round(bytes / 1e6), 0)} MB` : `${fixed(bytes / 1e9, 1)} GB`;
}
