import type { EstimateOptions, InputPlan } from "normalight";
import { byId, say, sayError, sayLines } from "./dom.js";
import type { Engine } from "./engine.js";
import { type Done, doJob, type Job, total } from "./job.js";
import type { SizeChoice } from "./large/size.js";
import { AS_THEY_ARE, type Taken, takenWords } from "./large/taken.js";
import { ProgressView } from "./progress.js";
import type { Settings } from "./settings.js";
import type { Stack } from "./stack.js";
import { texts } from "./texts/texts.js";

/** Files and settings in place of those on the page. */
interface Given {
  readonly files: readonly File[];
  readonly options: EstimateOptions;
}

/** Starts, follows and cancels runs. */
export class Run {
  readonly #start = byId<HTMLButtonElement>("start");
  readonly #cancel = byId<HTMLButtonElement>("cancel");
  readonly #problem = byId("run-problem");
  readonly #status = byId("status");
  readonly #notices = byId("notices");
  readonly #why = byId("start-why");
  readonly #progress = new ProgressView();
  #running: AbortController | undefined;
  /** How the result that is shown was made: what is made from it again must fit to its mask. */
  #taken: Taken = AS_THEY_ARE;

  constructor(
    private readonly form: HTMLFormElement,
    private readonly engine: Engine,
    private readonly stack: Stack,
    private readonly settings: Settings,
    private readonly size: SizeChoice,
    private readonly finished: (done: Done) => void,
  ) {
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.#run();
    });
    this.#cancel.addEventListener("click", () => this.#running?.abort());
  }

  /** Whether a run is under way. */
  get underWay(): boolean {
    return this.#running !== undefined;
  }

  /** Says what went wrong. */
  fail(error: unknown): void {
    sayError(this.#problem, error);
  }

  /** Says what became of several runs. */
  tell(words: string): void {
    say(this.#status, words);
  }

  /** The stack has changed: what was said about the last one is out of date. */
  stackChanged(): void {
    this.stackPlanned();
    say(this.#problem, "");
    say(this.#status, "");
    sayLines(this.#notices, []);
  }

  /** It is known now which files are photographs. */
  stackPlanned(): void {
    const { lacking } = this.stack;
    this.#start.disabled = lacking !== "";
    say(this.#why, lacking);
  }

  /** Files came while a run is under way, which they would replace. */
  ignore(): void {
    say(this.#status, texts.run.dropIgnored);
  }

  /** Leaving the page would end the run: the browser asks first. */
  readonly #asks = (event: BeforeUnloadEvent) => {
    event.preventDefault();
  };

  /** A run on some of the files with other settings, such as corrected lights. */
  async again(files: readonly File[], options: EstimateOptions): Promise<void> {
    await this.#run({ files, options });
  }

  /** What a run on the stack is made of now. */
  get job(): Job {
    const { files, pictures, photographs } = this.stack;
    const options = this.settings.optionsFor(photographs);
    const mask = options.mask instanceof File ? options.mask : undefined;
    const own = options.mask === "auto" ? this.stack.mask : undefined;
    return { files, pictures, options, mask: mask ?? own, taken: this.size.taken };
  }

  /** Why no run can begin with the stack and these settings; empty when one can. */
  get lacking(): string {
    return this.stack.lacking || this.settings.lacking(this.stack.photographs.length);
  }

  async #run(given?: Given): Promise<void> {
    if (this.underWay) {
      say(this.#status, texts.run.underWay);
      return;
    }
    if (this.stack.lacking !== "") return;
    const lacking = given ? "" : this.lacking;
    if (lacking) {
      say(this.#problem, lacking);
      return;
    }
    let done: Done | undefined;
    await this.during(async (signal) => {
      const { pictures } = this.stack;
      const job = given ? { ...given, pictures, mask: undefined, taken: this.#taken } : this.job;
      try {
        [, done] = await this.follow(async () => job, signal);
        say(this.#status, texts.run.done(total(done.estimate)));
        // What the lights that were found are worth is known only now.
        this.#tellNotices(done.estimate.plan, done.estimate.planWords, job.taken);
      } catch (error) {
        if (signal.aborted) say(this.#status, texts.run.cancelled);
        else this.fail(error);
      }
    });
    // Only now: the page has its final shape, and the focus goes to the result.
    if (done) this.finished(done);
  }

  /** Does something meanwhile nothing but cancelling is possible; not when something is under way already. */
  async during(work: (signal: AbortSignal) => Promise<void>): Promise<void> {
    if (this.underWay) return;
    const running = new AbortController();
    this.#running = running;
    this.#show(true);
    say(this.#problem, "");
    say(this.#status, "");
    sayLines(this.#notices, []);
    try {
      await work(running.signal);
    } finally {
      this.#running = undefined;
      this.#show(false);
    }
  }

  /** A job and its result; the progress is shown. @param which of several, in words */
  async follow(make: () => Promise<Job>, signal: AbortSignal, which = ""): Promise<[Job, Done]> {
    this.#progress.start(which);
    const job = await make();
    const done = await doJob(this.engine, job, {
      signal,
      prepare: (words) => this.#progress.prepare(words),
      progress: (progress) => this.#progress.show(progress),
      plan: (plan, words) => {
        if (which) return;
        this.#tellNotices(plan, words, job.taken);
        this.stack.mark(plan.notices);
      },
    });
    this.size.learn(done.estimate);
    return [job, done];
  }

  /** Shows what is doubtful. */
  #tellNotices(plan: InputPlan, words: readonly string[], taken: Taken): void {
    const lines = texts.plan.ofRun(plan, words, takenWords(taken));
    sayLines(
      this.#notices,
      lines.filter(({ doubtful }) => doubtful),
    );
  }

  /** A result is shown that was made like this. */
  resume(taken: Taken): void {
    this.#taken = taken;
  }

  /** While a run is under way nothing but cancelling is possible. */
  #show(running: boolean): void {
    for (const panel of this.form.querySelectorAll<HTMLElement>(".panel:not(.run)")) panel.inert = running;
    this.#start.hidden = running;
    if (running) {
      addEventListener("beforeunload", this.#asks);
      this.#progress.start();
      this.#cancel.focus();
    } else {
      removeEventListener("beforeunload", this.#asks);
      this.#progress.end();
      this.#start.focus({ preventScroll: true });
    }
  }
}
