// idb-keyval: IndexedDB's events as promises, in 600 bytes.
import { clear, createStore, delMany, get, getMany, set } from "idb-keyval";
import type { KeptQueue } from "../queue/state.js";

/**
 * Where the session lies in this browser: IndexedDB, which takes files as they are and copies them off this thread. Handles to
 * the user's files would save that copy, but inputs hand out none, and one that was changed or moved is lost.
 */
const stored = createStore("normalight.session", "parts");

/** One window at a time keeps its session: two would mix theirs. */
const LOCK = "normalight.session";

/** The parts of the session that this browser keeps, by their names. */
export class SessionStore {
  /** Resolves when this window may keep its session: at once, or when the one that does is closed. */
  readonly granted: Promise<void>;
  #owned = false;

  /** @param cleared hears when nothing is kept any more */
  constructor(private readonly cleared: () => void) {
    // Where there are no locks, which need a secure address, the last window wins.
    const { locks } = navigator;
    this.granted =
      locks === undefined ? Promise.resolve() : new Promise((resolve) => void hold(locks, resolve));
    this.granted.then(() => {
      this.#owned = true;
    });
  }

  /** Whether this window may keep its session. */
  get owned(): boolean {
    return this.#owned;
  }

  get<T>(name: string): Promise<T | undefined> {
    return get<T>(name, stored);
  }

  getMany<T>(names: readonly string[]): Promise<(T | undefined)[]> {
    return getMany<T>([...names], stored);
  }

  set(name: string, part: unknown): Promise<void> {
    return set(name, part, stored);
  }

  delete(...names: string[]): Promise<void> {
    return delMany(names, stored);
  }

  async clear(): Promise<void> {
    await clear(stored);
    this.cleared();
  }
}

/** The name of the results of a queue that the session keeps, whichever window has it. */
export async function keptResults(): Promise<string | undefined> {
  return (await get<Pick<KeptQueue, "name">>("queue", stored))?.name;
}

/** Holds the lock from when it is granted until the window ends. */
function hold(locks: LockManager, granted: () => void): Promise<void> {
  return locks.request(LOCK, () => {
    granted();
    return new Promise<void>(() => undefined);
  });
}

/** Bytes that this browser still takes; without end where it does not say. */
export async function room(): Promise<number> {
  const { quota, usage } = (await navigator.storage?.estimate()) ?? {};
  return quota === undefined ? Number.POSITIVE_INFINITY : quota - (usage ?? 0);
}
