import { NormalightError } from "./errors.js";
import type { FromWorker, TaskName, Tasks, ToWorker } from "./protocol.js";

/** Time for a cancelled task to end by itself, in milliseconds; then its worker goes. */
const GRACE = 2000;

/** Who follows a task. */
export interface Follow {
  readonly signal?: AbortSignal | undefined;
  readonly onNews?: ((news: Extract<FromWorker, { fraction: number }>) => void) | undefined;
}

interface Pending extends Follow {
  resolve(answer: unknown): void;
  reject(reason: unknown): void;
}

/** What is used of a worker. */
export type WorkerLike = Pick<Worker, "postMessage" | "terminate" | "onmessage" | "onerror">;

/** One worker, which does one task at a time, until it is lost. */
export class Connection {
  readonly #worker: WorkerLike;
  #pending: Pending | undefined;
  #lost: NormalightError | undefined;

  constructor(worker: WorkerLike) {
    this.#worker = worker;
    worker.onmessage = (event: MessageEvent<FromWorker>) => this.#hear(event.data);
    worker.onerror = (event) => {
      event.preventDefault?.();
      this.lose(crash(event.message ?? "the worker does not start"));
    };
  }

  /** Whether the worker is gone: broken, stopped or closed. */
  get lost(): boolean {
    return this.#lost !== undefined;
  }

  /** Does a task. The one before must have ended. */
  async run<T extends TaskName>(
    task: T,
    ask: Tasks[T]["ask"],
    follow: Follow = {},
  ): Promise<Tasks[T]["answer"]> {
    const { signal } = follow;
    signal?.throwIfAborted();
    if (this.#lost) throw this.#lost;
    let deadline: ReturnType<typeof setTimeout> | undefined;
    const cancel = () => {
      this.#worker.postMessage({ task: "cancel" } satisfies ToWorker);
      deadline = setTimeout(() => this.lose(crash("a cancelled run did not end")), GRACE);
    };
    signal?.addEventListener("abort", cancel, { once: true });
    try {
      return await new Promise<Tasks[T]["answer"]>((resolve, reject) => {
        this.#pending = { ...follow, resolve: resolve as Pending["resolve"], reject };
        this.#worker.postMessage({ task, ask } as ToWorker);
      });
    } catch (error) {
      // However a cancelled task ends, it ends as the caller wished.
      signal?.throwIfAborted();
      throw error;
    } finally {
      this.#pending = undefined;
      clearTimeout(deadline);
      signal?.removeEventListener("abort", cancel);
    }
  }

  /** Ends the worker and what it is doing. */
  lose(reason: NormalightError): void {
    if (this.#lost) return;
    this.#lost = reason;
    this.#worker.terminate();
    this.#pending?.reject(reason);
  }

  #hear(message: FromWorker): void {
    const pending = this.#pending;
    switch (message.news) {
      case "load":
      case "progress":
        pending?.onNews?.(message);
        break;
      case "done":
        pending?.resolve(message.answer);
        break;
      case "failed": {
        const kind = message.kind === "cancelled" ? "crashed" : message.kind;
        pending?.reject(new NormalightError(kind, message.message));
        break;
      }
      case "crashed":
        this.lose(crash(message.message));
    }
  }
}

function crash(words: string): NormalightError {
  return new NormalightError("crashed", `Something broke in the computation: ${words}`);
}
