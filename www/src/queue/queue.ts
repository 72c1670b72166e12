import type { Capture } from "../captures.js";
import { reasonOf } from "../dom.js";
import { fileNameOf, type Kept, store } from "../downloads.js";
import { type Done, type Job, total } from "../job.js";
import type { Format } from "../maps.js";
import type { Outcome } from "../result.js";
import type { Run } from "../run.js";
import { texts } from "../texts/texts.js";
import { jobOf, type Makings } from "./job.js";
import { QueueList } from "./list.js";
import { Results } from "./results.js";
import type { KeptQueue, State, Term } from "./state.js";

/** What a queue needs of the page. */
export interface QueuePage extends Makings {
  readonly run: Run;
  /** Which way green points now. */
  format(): Format;
  /** Shows a result, and puts its stack on the bench. */
  show(outcome: Outcome, entries: readonly Capture[], capture: Capture): void;
  /** What is to be kept of it for a reload has changed. */
  changed(): void;
}

/** Several stacks that are estimated one after the other; what is finished is kept, and one of them shown. */
export class Queue {
  readonly #page: QueuePage;
  readonly #list = new QueueList({
    show: (index) => void this.#show(index),
    zip: () => void this.#zip(),
    forget: () => void this.#forget(),
  });
  readonly #results = new Results();
  #captures: readonly Capture[] = [];
  #states: State[] = [];
  /** What became of keeping them. */
  #term: Term = "page";
  /** The one that was asked for last, and its result. */
  #wanted: number | undefined;
  #shown: Outcome | undefined;

  constructor(page: QueuePage) {
    this.#page = page;
  }

  /** Estimates captures. @param own the one that is on the bench, with what was set for it there */
  async start(captures: readonly Capture[], own: Capture | undefined): Promise<void> {
    const { run, size } = this.#page;
    if (run.underWay) return;
    // As everything is now: whoever looks at a result meanwhile puts its stack on the bench.
    const general = size.general;
    const ownJob = run.lacking === "" && run.job.pictures.size > 0 ? run.job : undefined;
    const make = (capture: Capture) =>
      capture === own && ownJob ? Promise.resolve(ownJob) : jobOf(this.#page, capture, general);
    const began = performance.now();
    await run.during(async (signal) => {
      await this.#begin(captures);
      for (const [index, capture] of captures.entries())
        await this.#estimate(index, () => make(capture), signal);
    });
    this.#list.end();
    const [first] = this.#done;
    run.tell(texts.queue.end(...this.#counts, (performance.now() - began) / 1000));
    if (first !== undefined && this.#wanted === undefined) await this.#show(first);
  }

  /** A result is shown: of this queue, or another. */
  shows(outcome: Outcome): void {
    if (outcome === this.#shown) return;
    this.#wanted = undefined;
    this.#list.mark(undefined);
  }

  /** Finished results, which can be had after a reload; none where some are in this page's memory only. */
  get kept(): KeptQueue | undefined {
    if (this.#done.length === 0 || this.#term === "memory") return undefined;
    const stacks = this.#captures.map(({ folder }, index) => ({
      folder,
      state: this.#states[index] ?? { kind: "waiting" as const },
      result: this.#results.light(index),
    }));
    return { name: this.#results.name, stacks, shown: this.#shown && this.#wanted };
  }

  /** Hears what became of keeping them for a reload. */
  keptFor(term: Exclude<Term, "memory">): void {
    if (this.#term === term || this.#term === "memory" || this.#captures.length === 0) return;
    this.#term = term;
    this.#tell();
  }

  /** Takes a queue that was kept. @param outcome the result that is shown */
  restore({ name, stacks, shown }: KeptQueue, outcome: Outcome | undefined): void {
    this.#results.adopt(
      name,
      stacks.map(({ result }) => result),
    );
    this.#captures = stacks.map(({ folder, result }) => ({ folder, files: result?.files ?? [] }));
    this.#list.begin(stacks.map(({ folder }) => folder));
    for (const [index, { state }] of stacks.entries())
      this.#say(index, isOver(state) ? state : { kind: "interrupted" });
    this.#list.end();
    this.#term = "reload";
    this.#tell();
    if (shown === undefined || !outcome) return;
    [this.#wanted, this.#shown] = [shown, outcome];
    this.#list.mark(shown);
  }

  /** Whether nothing of it is lost with the page. */
  get lasts(): boolean {
    return this.#done.length === 0 || this.#term === "reload";
  }

  /** Deletes what sessions left that are not kept any more. */
  sweep(): void {
    void this.#results.sweep().catch(() => undefined);
  }

  async #begin(captures: readonly Capture[]): Promise<void> {
    this.#captures = captures;
    [this.#states, this.#term] = [captures.map(() => ({ kind: "waiting" })), "page"];
    [this.#wanted, this.#shown] = [undefined, undefined];
    this.#list.begin(captures.map(({ folder }) => folder));
    this.#tell();
    this.#page.changed();
    await this.#results.clear();
  }

  /** The result of one stack, or why there is none; the others come either way. */
  async #estimate(index: number, make: () => Promise<Job>, signal: AbortSignal): Promise<void> {
    const { folder = "" } = this.#captures[index] ?? {};
    const { run } = this.#page;
    try {
      signal.throwIfAborted();
      this.#say(index, { kind: "now" });
      const which = texts.queue.stack(index + 1, this.#captures.length, folder);
      const [job, done] = await run.follow(make, signal, which);
      const outcome = { ...done, files: job.files, name: folder, format: this.#page.format() };
      const kept = await this.#results.keep(index, outcome);
      if (!kept) this.#term = "memory";
      this.#say(index, { kind: "done", facts: factsOf(done) });
      this.#page.changed();
    } catch (error) {
      this.#say(index, signal.aborted ? { kind: "cancelled" } : { kind: "failed", reason: reasonOf(error) });
    }
    this.#tell();
  }

  #say(index: number, state: State): void {
    this.#states[index] = state;
    this.#list.tell(index, state);
  }

  /** Those that are finished. */
  get #done(): number[] {
    return this.#states.flatMap(({ kind }, index) => (kind === "done" ? index : []));
  }

  /** How many are done, of how many, and how many failed. */
  get #counts(): [number, number, number] {
    const failed = this.#states.filter(({ kind }) => kind === "failed").length;
    return [this.#done.length, this.#captures.length, failed];
  }

  #tell(): void {
    this.#list.say(texts.queue.sofar(...this.#counts, this.#term));
  }

  async #show(index: number): Promise<void> {
    this.#wanted = index;
    this.#list.fail();
    try {
      const outcome = await this.#results.read(index);
      const capture = this.#captures[index];
      if (this.#wanted !== index || !capture) return;
      this.#shown = outcome;
      this.#list.mark(index);
      // After a reload those that are not finished have no photographs.
      const some = this.#captures.filter(({ files }) => files.length > 0);
      this.#page.show(outcome, some, capture);
    } catch (error) {
      this.#list.fail(error);
    }
  }

  /** One archive with a folder for each finished stack. */
  async #zip(): Promise<void> {
    this.#list.fail();
    this.#list.packing = true;
    try {
      const { zipOfFolders } = await import("../out/zip.js");
      store("stacks.zip", await zipOfFolders(this.#folders()));
    } catch (error) {
      this.#list.fail(error);
    }
    this.#list.packing = false;
  }

  async *#folders(): AsyncGenerator<{ folder: string; files: readonly Kept[] }> {
    const names = new Set<string>();
    for (const index of this.#done) {
      const { name, estimate } = await this.#results.read(index);
      const plain = fileNameOf(name);
      const folder = names.has(plain) ? `${plain}-${index + 1}` : plain;
      names.add(folder);
      yield { folder, files: estimate.files };
    }
  }

  async #forget(): Promise<void> {
    this.#list.close();
    [this.#captures, this.#states] = [[], []];
    this.#page.changed();
    await this.#results.clear();
  }
}

function factsOf({ estimate, taken }: Done) {
  const { width, height, lights } = estimate;
  return { photographs: lights.length, width, height, seconds: total(estimate), taken };
}

/** Whether nothing more comes of a stack. */
function isOver({ kind }: State): boolean {
  return kind !== "waiting" && kind !== "now";
}
