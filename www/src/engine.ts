import { type DeviceChoice, Normalight, NormalightError } from "normalight";
import { byId, english, say, sayError } from "./dom.js";
import { texts } from "./texts/texts.js";

/** The estimator on the chosen device, and the words about it. */
export class Engine {
  readonly #pill = byId("engine");
  readonly #words = byId("engine-words");
  readonly #notice = byId("device-notice");
  #choice: DeviceChoice = "auto";
  #current: Promise<Normalight>;
  /** What `#current` gave. */
  #live: Normalight | undefined;

  /** @param loaded hears each time that it is there */
  constructor(private readonly loaded: () => void) {
    this.#current = this.#start();
  }

  /** What computes; the processor, as long as nothing has started. */
  get kind(): "gpu" | "cpu" {
    return this.#live?.device.kind ?? "cpu";
  }

  /** Starts the estimator anew on another device. */
  use(choice: DeviceChoice): void {
    if (choice === this.#choice) return;
    this.#choice = choice;
    this.#current.then((normalight) => normalight.close()).catch(() => undefined);
    this.#current = this.#start();
  }

  /** Does something with the estimator; once more when another device was chosen meanwhile. */
  async with<T>(work: (normalight: Normalight) => Promise<T>): Promise<T> {
    for (;;) {
      const normalight = await this.ready();
      try {
        return await work(normalight);
      } catch (error) {
        if (!(error instanceof NormalightError && error.kind === "closed")) throw error;
      } finally {
        // A crash may have changed it.
        this.#tell(normalight);
      }
    }
  }

  /** The estimator, as soon as it is ready; after a failed start it is tried again. */
  private async ready(): Promise<Normalight> {
    const current = this.#current;
    try {
      return await current;
    } catch {
      if (current === this.#current) this.#current = this.#start();
      return await this.#current;
    }
  }

  #start(): Promise<Normalight> {
    this.#live = undefined;
    this.#show("loading", texts.engine.loading);
    say(this.#notice, "");
    const started = Normalight.create({
      device: this.#choice,
      onLoad: (fraction) => {
        const percent = Math.round(100 * fraction);
        if (this.#current === started) this.#show("loading", texts.engine.loadingPercent(percent));
      },
      onDevice: () => void started.then((normalight) => this.#tell(normalight)),
    });
    started.then(
      (normalight) => {
        if (this.#current !== started) return;
        this.#live = normalight;
        this.#tell(normalight);
        this.loaded();
      },
      (error: unknown) => {
        if (this.#current !== started) return;
        this.#pill.dataset.state = "failed";
        sayError(this.#words, error);
      },
    );
    return started;
  }

  /** Says what computes, unless another device was chosen meanwhile. */
  #tell(normalight: Normalight): void {
    if (normalight !== this.#live) return;
    const { kind, notice } = normalight.device;
    this.#show("ready", texts.engine.ready[kind]);
    this.#notice.hidden = notice === undefined;
    this.#notice.replaceChildren(notice ? (texts.engine.notices[notice] ?? english(notice)) : "");
  }

  #show(state: "loading" | "ready", words: string): void {
    this.#pill.dataset.state = state;
    this.#words.textContent = words;
  }
}
