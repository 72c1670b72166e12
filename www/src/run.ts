import type { Estimate, EstimateOptions, InputPlan, Progress } from "normalight";
import { byId, doubtful, say, sayLines, wordsOf } from "./dom.js";
import type { Engine } from "./engine.js";
import { type Shrinking, shrunk, sizeWords } from "./large/shrink.js";
import type { SizeChoice } from "./large/size.js";
import { ProgressView } from "./progress.js";
import type { Settings } from "./settings.js";
import type { Stack } from "./stack.js";

/** Files and settings in place of those on the page. */
interface Given {
  readonly files: readonly File[];
  readonly options: EstimateOptions;
}

/** What a run gave. */
export interface Done {
  readonly estimate: Estimate;
  /** The files as the estimator got them: photographs may have been made smaller. */
  readonly used: readonly File[];
  /** At which size the photographs were taken; empty for their own. */
  readonly size: string;
  /** How many times smaller that made their sides. */
  readonly times: Shrinking;
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
  /** At which size the result that is shown was made: what is made from it again must fit to its mask. */
  #times: Shrinking = 1;

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
  fail(words: string): void {
    say(this.#problem, words);
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
    say(
      this.#status,
      "A run is under way: what was dropped is ignored. Cancel the run first, then try again.",
    );
  }

  /** Leaving the page would end the run: the browser asks first. */
  readonly #asks = (event: BeforeUnloadEvent) => {
    event.preventDefault();
  };

  /** A run on some of the files with other settings, such as corrected lights. */
  async again(files: readonly File[], options: EstimateOptions): Promise<void> {
    await this.#run({ files, options });
  }

  async #run(given?: Given): Promise<void> {
    if (this.#running || this.stack.lacking !== "") return;
    const lacking = given ? "" : this.settings.lacking(this.stack.photographs.length);
    if (lacking) {
      say(this.#problem, lacking);
      return;
    }
    const running = new AbortController();
    this.#running = running;
    this.#show(true);
    say(this.#problem, "");
    say(this.#status, "");
    sayLines(this.#notices, []);
    const done = await this.#estimate(running.signal, given);
    this.#running = undefined;
    this.#show(false);
    // Only now: the page has its final shape, and the focus goes to the result.
    if (done) this.finished(done);
  }

  /** The result; nothing when there is none, which the page then says. */
  async #estimate(signal: AbortSignal, given?: Given): Promise<Done | undefined> {
    const files = given?.files ?? this.stack.files;
    const times = given ? this.#times : this.size.times;
    const options = {
      ...(given?.options ?? this.settings.optionsFor(this.stack.photographs)),
      signal,
      onProgress: (progress: Progress) => this.#progress.show(progress),
      onPlan: (plan: InputPlan, words: readonly string[]) => {
        sayLines(this.#notices, doubtful(words));
        this.stack.mark(plan.notices);
      },
    };
    try {
      const used = await shrunk(files, this.stack.pictures, times, signal, (done, of) =>
        this.#progress.prepare(`Making photographs smaller: ${done + 1} of ${of}`),
      );
      const estimate = await this.engine.with((normalight) => normalight.estimate(used, options));
      say(this.#status, `Done in ${total(estimate).toFixed(1)} s.`);
      // What the lights that were found are worth is known only now.
      sayLines(this.#notices, doubtful(estimate.planWords));
      this.#times = times;
      this.size.learn(estimate);
      const size = sizeWords(times, this.size.whole);
      return { estimate: size ? sized(estimate, size) : estimate, used, size, times };
    } catch (error) {
      if (signal.aborted) say(this.#status, "Cancelled. The photographs are still here.");
      else say(this.#problem, wordsOf(error));
      return undefined;
    }
  }

  /** The result that is shown is one of another visit, made at this size. */
  resume(times: Shrinking): void {
    this.#times = times;
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

/** An estimate that says at which size photographs were taken, in words and in its report. */
function sized(estimate: Estimate, size: string): Estimate {
  const words = `photographs: taken ${size}, as PNG of 8 bits that the page made of them`;
  const text = new TextEncoder();
  const files = estimate.files.map((file) => {
    if (file.name !== "report.json") return file;
    const report = JSON.parse(new TextDecoder().decode(file.bytes));
    return {
      ...file,
      bytes: text.encode(`${JSON.stringify({ ...report, photographs_taken: size }, null, 2)}\n`),
    };
  });
  return { ...estimate, files, planWords: [words, ...estimate.planWords] };
}

/** Seconds of all stages. */
export function total({ seconds }: Pick<Estimate, "seconds">): number {
  return seconds.reduce((sum, stage) => sum + stage.seconds, 0);
}
