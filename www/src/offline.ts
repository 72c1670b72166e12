import type { Answered, Asked } from "../service-worker/messages.js";
import { byId, say } from "./dom.js";
import { texts } from "./texts/texts.js";

/** The page kept in the browser for work without a network, and what is said about its versions. */
export class Offline {
  readonly #words = byId("offline-words");
  readonly #version = byId("version");
  readonly #versionWords = byId("version-words");
  readonly #reload = byId<HTMLButtonElement>("version-reload");
  /** Whether a reload would lose nothing. */
  readonly #free: () => boolean;
  /** A version that is complete and waits for this one to end. */
  #waiting: ServiceWorker | undefined;
  /** Fulfilled once answers and other versions are listened for. */
  readonly #following: Promise<void> | undefined;

  constructor(free: () => boolean) {
    this.#free = free;
    this.#reload.addEventListener("click", () => this.#ask("take over"));
    // Neither in windows without a secure address nor in every private one; the page works without.
    const registering = navigator.serviceWorker?.register("./service-worker.js", { updateViaCache: "none" });
    this.#following = registering?.then(
      (registration) => registration && this.#follow(registration),
      () => undefined,
    );
  }

  /** The estimator is loaded: what it was loaded from can be kept without being in its way. */
  async keep(): Promise<void> {
    await this.#following;
    const registration = await navigator.serviceWorker?.ready;
    registration?.active?.postMessage("keep" satisfies Asked);
  }

  /** Something began or ended that a reload would lose. */
  look(): void {
    this.#version.hidden = this.#waiting === undefined || !this.#free();
  }

  #follow(registration: ServiceWorkerRegistration): void {
    const { serviceWorker } = navigator;
    serviceWorker.addEventListener("message", ({ data }) => this.#hear(data as Answered));
    // The first visit is taken over, too, and goes on.
    serviceWorker.addEventListener("controllerchange", () => {
      if (this.#waiting) location.reload();
    });
    this.#found(registration.waiting);
    // This window was reloaded while a version waited: nothing has begun yet, so that one is wished.
    if (this.#waiting && this.#free()) this.#ask("take over");
    const watch = () => {
      registration.installing?.addEventListener("statechange", () => this.#found(registration.waiting));
    };
    // One may be on its way already.
    watch();
    registration.addEventListener("updatefound", watch);
  }

  #found(waiting: ServiceWorker | null): void {
    // Without a version before there is none to be replaced.
    if (!waiting || !navigator.serviceWorker.controller) return;
    this.#waiting = waiting;
    this.#versionWords.textContent = texts.offline.newVersion;
    this.look();
  }

  #ask(asked: Asked): void {
    this.#waiting?.postMessage(asked);
  }

  #hear(answer: Answered): void {
    if (answer === "kept") {
      say(this.#words, texts.offline.kept);
      return;
    }
    this.#versionWords.textContent = texts.offline.newVersionWaits;
  }
}
