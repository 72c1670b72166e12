import { NormalightError } from "./errors.js";
import type { FromWorker, TaskName, Tasks, ToWorker } from "./protocol.js";

/** Time for a cancelled task to end by itself, in milliseconds; then its worker goes. */
const GRACE = 2000;

/** Who follows a task. */
export interface Follow {
  readonly signal?: AbortSignal | undefined;
  readonly onEvent?:
    | ((event: Extract<FromWorker, { event: "load" | "progress" | "plan" }>) => void)
    | undefined;
}

interface Pending extends Follow {
  resolve(response: unknown): void;
  reject(reason: unknown): void;
}

/** What is used of a worker. */
export type WorkerLike = Pick<Worker, "postMessage" | "terminate" | "onmessage" | "onerror">;

/** One worker, which does one task at a time, until it is terminated. */
export class Connection {
  readonly #worker: WorkerLike;
  #pending: Pending | undefined;
  #terminated: NormalightError | undefined;

  constructor(worker: WorkerLike) {
    this.#worker = worker;
    worker.onmessage = (event: MessageEvent<FromWorker>) => this.#hear(event.data);
    worker.onerror = (event) => {
      event.preventDefault?.();
      this.terminate(crash(event.message ?? "the worker does not start"));
    };
  }

  /** Whether the worker is gone: broken, stopped or closed. */
  get terminated(): boolean {
    return this.#terminated !== undefined;
  }

  /** Does a task. The one before must have ended. */
  async run<T extends TaskName>(
    task: T,
    request: Tasks[T]["request"],
    follow: Follow = {},
  ): Promise<Tasks[T]["response"]> {
    const { signal } = follow;
    signal?.throwIfAborted();
    if (this.#terminated) throw this.#terminated;
    let deadline: ReturnType<typeof setTimeout> | undefined;
    const cancel = () => {
      this.#worker.postMessage({ task: "cancel" } satisfies ToWorker);
      deadline = setTimeout(() => this.terminate(crash("a cancelled run did not end")), GRACE);
    };
    signal?.addEventListener("abort", cancel, { once: true });
    try {
      return await new Promise<Tasks[T]["response"]>((resolve, reject) => {
        this.#pending = { ...follow, resolve: resolve as Pending["resolve"], reject };
        this.#worker.postMessage({ task, request } as ToWorker);
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
  terminate(reason: NormalightError): void {
    if (this.#terminated) return;
    this.#terminated = reason;
    this.#worker.terminate();
    this.#pending?.reject(reason);
  }

  #hear(message: FromWorker): void {
    const pending = this.#pending;
    switch (message.event) {
      case "load":
      case "progress":
      case "plan":
        pending?.onEvent?.(message);
        break;
      case "done":
        pending?.resolve(message.response);
        break;
      case "failed": {
        const kind = message.kind === "cancelled" ? "crashed" : message.kind;
        pending?.reject(new NormalightError(kind, message.message));
        break;
      }
      case "crashed":
        this.terminate(crash(message.message));
    }
  }
}

function crash(words: string): NormalightError {
  return new NormalightError("crashed", `Something broke in the computation: ${words}`);
}
