import type { Capture } from "../captures.js";
import { wordsOf } from "../dom.js";
import { fileNameOf, type Kept, store } from "../downloads.js";
import { type Done, type Job, total } from "../job.js";
import type { Format } from "../maps.js";
import type { Outcome } from "../result.js";
import type { Run } from "../run.js";
import { texts } from "../texts/texts.js";
import { jobOf, type Makings } from "./job.js";
import { QueueList } from "./list.js";
import { Results } from "./results.js";

/** What a queue needs of the page. */
export interface QueuePage extends Makings {
  readonly run: Run;
  /** Which way green points now. */
  format(): Format;
  /** Shows a result, and puts its stack on the bench. */
  show(outcome: Outcome, entries: readonly Capture[], capture: Capture): void;
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
  /** Those that are finished, in their order. */
  #done: number[] = [];
  #failed = 0;
  #inMemory = false;
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
    run.tell(texts.queue.end(...this.#counts, (performance.now() - began) / 1000));
    const [first] = this.#done;
    if (first !== undefined && this.#wanted === undefined) await this.#show(first);
  }

  /** A result is shown: of this queue, or another. */
  shows(outcome: Outcome): void {
    if (outcome === this.#shown) return;
    this.#wanted = undefined;
    this.#list.mark(undefined);
  }

  async #begin(captures: readonly Capture[]): Promise<void> {
    this.#captures = captures;
    [this.#done, this.#failed, this.#inMemory] = [[], 0, false];
    [this.#wanted, this.#shown] = [undefined, undefined];
    this.#list.begin(captures.map(({ folder }) => folder));
    this.#tell();
    await this.#results.clear();
  }

  /** The result of one stack, or why there is none; the others come either way. */
  async #estimate(index: number, make: () => Promise<Job>, signal: AbortSignal): Promise<void> {
    const { folder = "" } = this.#captures[index] ?? {};
    const { run } = this.#page;
    try {
      signal.throwIfAborted();
      this.#list.tell(index, "now", texts.queue.now);
      const which = texts.queue.stack(index + 1, this.#captures.length, folder);
      const [job, done] = await run.follow(make, signal, which);
      const outcome = { ...done, files: job.files, name: folder, format: this.#page.format() };
      const kept = await this.#results.keep(index, outcome);
      this.#inMemory ||= !kept;
      this.#done.push(index);
      this.#list.tell(index, "done", doneWords(done));
    } catch (error) {
      if (!signal.aborted) this.#failed += 1;
      if (signal.aborted) this.#list.tell(index, "cancelled", texts.queue.cancelled);
      else this.#list.tell(index, "failed", texts.queue.failed(wordsOf(error)));
    }
    this.#tell();
  }

  /** How many are done, of how many, and how many failed. */
  get #counts(): [number, number, number] {
    return [this.#done.length, this.#captures.length, this.#failed];
  }

  #tell(): void {
    this.#list.say(texts.queue[this.#inMemory ? "inMemory" : "sofar"](...this.#counts));
  }

  async #show(index: number): Promise<void> {
    this.#wanted = index;
    this.#list.fail("");
    try {
      const outcome = await this.#results.read(index);
      const capture = this.#captures[index];
      if (this.#wanted !== index || !capture) return;
      this.#shown = outcome;
      this.#list.mark(index);
      this.#page.show(outcome, this.#captures, capture);
    } catch (error) {
      this.#list.fail(wordsOf(error));
    }
  }

  /** One archive with a folder for each finished stack. */
  async #zip(): Promise<void> {
    this.#list.fail("");
    this.#list.packing = true;
    try {
      const { zipOfFolders } = await import("../out/zip.js");
      store("stacks.zip", await zipOfFolders(this.#folders()));
    } catch (error) {
      this.#list.fail(wordsOf(error));
    }
    this.#list.packing = false;
  }

  async *#folders(): AsyncGenerator<{ folder: string; files: readonly Kept[] }> {
    const names = new Set<string>();
    for (const index of [...this.#done]) {
      const { name, estimate } = await this.#results.read(index);
      const plain = fileNameOf(name);
      const folder = names.has(plain) ? `${plain}-${index + 1}` : plain;
      names.add(folder);
      yield { folder, files: estimate.files };
    }
  }

  async #forget(): Promise<void> {
    this.#list.close();
    [this.#captures, this.#done] = [[], []];
    await this.#results.clear();
  }
}

function doneWords({ estimate, size }: Done): string {
  const { width, height, lights } = estimate;
  return texts.queue.done(lights.length, width, height, size, total(estimate));
}
