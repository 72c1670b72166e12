import type { FeatureParcel, HelperPool, InputFile } from "../wasm/normalight.js";
import { Connection } from "./connection.js";
import { NormalightError } from "./errors.js";
import type { Surroundings } from "./surroundings.js";

/** Most threads that compute when nobody says how many: each holds some hundred megabytes while it works. */
const MOST = 4;

/**
 * How many threads compute: as many as are wished for, or as there are, within reason.
 *
 * @throws `input` for a wish that is no number of threads
 */
export function threadCount(wished: number | undefined, cores: number): number {
  if (wished === undefined) return Math.max(1, Math.min(cores, MOST));
  if (Number.isInteger(wished) && wished >= 1) return wished;
  throw { kind: "input", message: `threads: found ${wished}, a whole number from 1 is expected` };
}

/** A helper, and the end of what it was given last while that is under way. */
interface Member {
  readonly connection: Connection;
  last?: Promise<void> | undefined;
}

/**
 * Workers that each hold a module of their own and do a part of the normal network's work. One that fails is not asked again,
 * and its part is done by who asked.
 */
export class Helpers implements HelperPool {
  #members: Member[] = [];

  /** Starts so many; each prepares itself while the photographs are read. */
  constructor(
    count: number,
    { startHelper }: Surroundings,
    request: { readonly module: WebAssembly.Module; readonly normal: InputFile },
  ) {
    try {
      for (let started = 0; startHelper && started < count; started++) {
        const member: Member = { connection: new Connection(startHelper()) };
        this.#members.push(member);
        this.#ask(member, () => member.connection.run("help", request)).catch(() => undefined);
      }
    } catch {
      // Where no worker can be started, there is one thread.
    }
  }

  get count(): number {
    return this.#members.length;
  }

  async features(
    helper: number,
    shapes: Uint32Array,
    values: Float32Array,
  ): Promise<FeatureParcel | undefined> {
    const member = this.#members[helper];
    if (member === undefined) return undefined;
    const run = () => member.connection.run("features", { shapes, values });
    return await this.#ask(member, run).catch(() => undefined);
  }

  /** Asks at once, or when the last work has ended: what a cancelled run asked for may still be under way. */
  async #ask<T>(member: Member, run: () => Promise<T>): Promise<T> {
    // Who asks computes for seconds afterwards, during which no promise goes on.
    const answer = member.last?.then(run) ?? run();
    const last = answer.then(
      () => undefined,
      () => this.#leave(member.connection),
    );
    member.last = last;
    last.then(() => {
      if (member.last === last) member.last = undefined;
    });
    return await answer;
  }

  /** Ends all of them. */
  free(): void {
    for (const { connection } of this.#members) this.#leave(connection);
  }

  #leave(connection: Connection): void {
    this.#members = this.#members.filter((member) => member.connection !== connection);
    connection.terminate(new NormalightError("closed", "the helper is not needed any more"));
  }
}
