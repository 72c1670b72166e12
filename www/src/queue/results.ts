import { createStore, delMany, get, keys, set } from "idb-keyval";
import type { Outcome } from "../result.js";
import { pack, unpack } from "../session/pack.js";
import { keptResults } from "../session/store.js";
import { texts } from "../texts/texts.js";
import type { Light } from "./state.js";

/** Where results of queues lie in this browser, by a name of their queue and their number. */
const stored = createStore("normalight.queue", "results");

/** What a window holds as long as it has a queue of this name. */
const LOCK = "normalight.queue ";

/** The part of a result that is stored. */
interface Stored {
  /** Packed. */
  readonly estimate: unknown;
  /** Photographs that were cropped or made smaller, at their places among those that were used. */
  readonly made: readonly (File | undefined)[];
}

/** A result of which the browser holds what is large; or all of it, where it has no room. */
type Held = { readonly outcome: Outcome } | { readonly light: Light };

/** Results of a queue: in the browser, so that memory does not grow with their number; the session may keep them. */
export class Results {
  #name: string = crypto.randomUUID?.() ?? String(Math.random());
  readonly #held = new Map<number, Held>();

  constructor() {
    this.#lock();
    // A browser that keeps nothing has nothing left.
    this.sweep().catch(() => undefined);
  }

  /** Under which name they lie in the browser. */
  get name(): string {
    return this.#name;
  }

  /** Takes the results of a session that was kept, in place of its own. */
  adopt(name: string, lights: readonly (Light | undefined)[]): void {
    this.#name = name;
    this.#lock();
    this.#held.clear();
    for (const [index, light] of lights.entries()) if (light) this.#held.set(index, { light });
  }

  /** A result without what lies in the browser; none where all of it is in memory. */
  light(index: number): Light | undefined {
    const held = this.#held.get(index);
    return held && "light" in held ? held.light : undefined;
  }

  /** Keeps a result; false where that must be in this page's memory. */
  async keep(index: number, outcome: Outcome): Promise<boolean> {
    const { estimate, ...light } = outcome;
    const own = new Set(outcome.files);
    const made = outcome.used.map((file) => (own.has(file) ? undefined : file));
    try {
      await set(this.#key(index), { estimate: await pack(estimate), made } satisfies Stored, stored);
      this.#held.set(index, { light: { ...light, used: outcome.used.filter((file) => own.has(file)) } });
      return true;
    } catch {
      this.#held.set(index, { outcome });
      return false;
    }
  }

  /** A result that was kept. */
  async read(index: number): Promise<Outcome> {
    const held = this.#held.get(index);
    if (!held) throw new Error(texts.queue.notKept);
    if ("outcome" in held) return held.outcome;
    const kept = await get<Stored>(this.#key(index), stored);
    if (!kept) throw new Error(texts.queue.deleted);
    const own = held.light.used[Symbol.iterator]();
    const used = kept.made.flatMap((file) => file ?? own.next().value ?? []);
    return { ...held.light, used, estimate: (await unpack(kept.estimate)) as Outcome["estimate"] };
  }

  /** Gives all of them up. */
  async clear(): Promise<void> {
    this.#held.clear();
    // Those, too, that were written last before the page was closed, of which the session knows nothing.
    await remove((name) => name === this.#name).catch(() => undefined);
  }

  /** Deletes what other windows left that are gone, unless the session keeps it. */
  async sweep(): Promise<void> {
    const kept = await keptResults();
    const { held = [] } = (await navigator.locks?.query()) ?? {};
    const alive = new Set([LOCK + this.#name, LOCK + kept, ...held.map(({ name }) => name)]);
    await remove((name) => !alive.has(LOCK + name));
  }

  #key(index: number): string {
    return `${this.#name} ${index}`;
  }

  #lock(): void {
    navigator.locks?.request(LOCK + this.#name, () => new Promise<void>(() => undefined));
  }
}

/** Deletes the results of queues with such names. */
async function remove(which: (name: string) => boolean): Promise<void> {
  const gone = (await keys<string>(stored)).filter((key) => which(key.split(" ")[0] ?? ""));
  if (gone.length > 0) await delMany(gone, stored);
}
