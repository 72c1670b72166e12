import { NormalightError } from "./errors.js";
import type { FromWorker, TaskName, Tasks, ToWorker } from "./protocol.js";
import type { DeviceReport } from "./types.js";

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
export interface WorkerLike {
  postMessage(message: ToWorker): void;
  terminate(): void;
  // Written as methods, because a browser's own handlers ask for more than what is used here.
  onmessage: { call(event: { data: FromWorker }): void }["call"] | null;
  onerror: { call(event: { message?: string; preventDefault?(): void }): void }["call"] | null;
}

/** One worker, which does one task at a time, until it is terminated. */
export class Connection {
  readonly #worker: WorkerLike;
  #pending: Pending | undefined;
  #terminated: NormalightError | undefined;
  /** Whether the worker has ever said anything. */
  #heard = false;
  #gpuFault: string | undefined;
  /** Hears when another device computes than was said. */
  onDevice: (device: DeviceReport) => void = () => undefined;

  /** @param advice what helps where a worker never says anything */
  constructor(worker: WorkerLike, advice = "") {
    this.#worker = worker;
    worker.onmessage = (event) => this.#hear(event.data);
    worker.onerror = (event) => {
      event.preventDefault?.();
      const reason = event.message;
      const start = () =>
        new NormalightError("load", `The worker does not start${reason ? `: ${reason}` : ""}. ${advice}`);
      this.terminate(this.#heard ? crash(reason ?? "the worker fails") : start());
    };
  }

  /** Whether the worker is gone: broken, stopped or closed. */
  get terminated(): boolean {
    return this.#terminated !== undefined;
  }

  /** The words of the crash if it may be the GPU's. */
  get gpuFault(): string | undefined {
    return this.#gpuFault;
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
    this.#heard = true;
    switch (message.event) {
      case "alive":
        void this.#watch(message.lock);
        break;
      case "device":
        this.onDevice(message.device);
        break;
      case "load":
      case "progress":
      case "plan":
        pending?.onEvent?.(message);
        break;
      case "done":
        pending?.resolve(message.response);
        break;
      case "failed": {
        const code = message.kind === "cancelled" ? "crashed" : message.kind;
        pending?.reject(new NormalightError(code, message.message));
        break;
      }
      case "crashed":
        if (message.gpu) this.#gpuFault = message.message;
        this.terminate(crash(message.message));
    }
  }

  /** Waits for the lock that the worker holds as long as it lives. */
  async #watch(lock: string): Promise<void> {
    await globalThis.navigator.locks.request(lock, () => this.terminate(crash("the worker ended by itself")));
  }
}

function crash(words: string): NormalightError {
  return new NormalightError("crashed", `Something broke in the computation: ${words}`);
}
