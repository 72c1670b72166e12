import { language } from "../texts/language.js";
import type { HandLight } from "./light.js";

/** Lights that stay where they are from object to object, under a name. */
export interface Rig {
  readonly name: string;
  readonly lights: readonly HandLight[];
}

/** Where the browser keeps them. */
const KEY = "normalight.rigs";

/** The rigs that this browser keeps; they never leave it. */
export class Rigs {
  readonly #heard = new Set<() => void>();
  #rigs: Rig[] = stored();

  constructor() {
    // Another window of the page has changed them.
    addEventListener("storage", ({ key }) => {
      if (key !== KEY) return;
      this.#rigs = stored();
      this.#tell();
    });
  }

  get all(): readonly Rig[] {
    return this.#rigs;
  }

  onChange(hear: () => void): void {
    this.#heard.add(hear);
  }

  /** Keeps a rig; one of the same name is replaced. */
  keep(rig: Rig): void {
    this.#set([...this.#rigs.filter(({ name }) => name !== rig.name), rig]);
  }

  /** Gives a rig another name; whether that was free. */
  rename(from: string, to: string): boolean {
    if (to === from) return true;
    if (to === "" || this.#rigs.some(({ name }) => name === to)) return false;
    this.#set(this.#rigs.map((rig) => (rig.name === from ? { ...rig, name: to } : rig)));
    return true;
  }

  delete(name: string): void {
    this.#set(this.#rigs.filter((rig) => rig.name !== name));
  }

  #set(rigs: Rig[]): void {
    const sorted = rigs.sort((a, b) => a.name.localeCompare(b.name, language, { numeric: true }));
    // First: a browser that keeps nothing says so by an error, and the list must not pretend.
    localStorage.setItem(KEY, JSON.stringify(sorted));
    this.#rigs = sorted;
    this.#tell();
  }

  #tell(): void {
    for (const hear of this.#heard) hear();
  }
}

/** What is kept; whatever else lies there is ignored. */
function stored(): Rig[] {
  try {
    const read: unknown = JSON.parse(localStorage.getItem(KEY) ?? "[]");
    if (!Array.isArray(read)) return [];
    return read.filter(
      (rig): rig is Rig => typeof Object(rig).name === "string" && Array.isArray(Object(rig).lights),
    );
  } catch {
    return [];
  }
}
