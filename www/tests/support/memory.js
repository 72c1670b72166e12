/** @typedef {{ usedSize: number, embedderHeapUsedSize: number, backingStorageSize: number }} Heap */

/** Shares of what is held by which two looks at it may differ while nothing happens. */
const SAME = 0.01;

/** What a page and its workers hold once all that is unused was given back, by Chromium's protocol. */
export class Memory {
  /** @type {import("playwright-core").CDPSession} */
  #page;
  /** @type {Set<string>} */
  #workers = new Set();
  /** @type {Map<number, (answer: any) => void>} */
  #waiting = new Map();
  #asked = 0;

  /** @param {import("playwright-core").CDPSession} page */
  constructor(page) {
    this.#page = page;
    page.on("Target.attachedToTarget", ({ sessionId }) => this.#workers.add(sessionId));
    page.on("Target.detachedFromTarget", ({ sessionId }) => this.#workers.delete(sessionId));
    page.on("Target.receivedMessageFromTarget", ({ message }) => {
      const answer = JSON.parse(message);
      this.#waiting.get(answer.id)?.(answer.result);
    });
  }

  /** @param {import("playwright-core").Page} tab */
  static async of(tab) {
    const session = await tab.context().newCDPSession(tab);
    const memory = new Memory(session);
    // Not flat: a session of playwright's hears its own target only.
    const attach = { autoAttach: true, waitForDebuggerOnStart: false, flatten: false };
    await session.send("Target.setAutoAttach", attach);
    return memory;
  }

  /**
   * Bytes of the page's heap with its elements and buffers, those of the workers' heaps, and those of their modules'
   * memories; and how many nodes documents have. Looks until it has seen the same twice: what a page does when it has
   * time is over then.
   */
  async held() {
    for (let before; ; ) {
      const now = await this.#look();
      if (before && Math.abs(now.page / before.page - 1) < SAME) return now;
      before = now;
    }
  }

  async #look() {
    // Twice: what the first one finalises is free for the second.
    for (let time = 0; time < 2; time++) await this.#page.send("HeapProfiler.collectGarbage");
    const found = {
      page: bytes(/** @type {Heap} */ (await this.#page.send("Runtime.getHeapUsage"))),
      nodes: (await this.#page.send("Memory.getDOMCounters")).nodes,
      workers: 0,
      modules: 0,
    };
    for (const worker of this.#workers) {
      await this.#ask(worker, "HeapProfiler.collectGarbage");
      found.workers += bytes(await this.#ask(worker, "Runtime.getHeapUsage"));
      const memory = { expression: "WebAssembly.Memory.prototype" };
      const { result } = await this.#ask(worker, "Runtime.evaluate", memory);
      const { objects } = await this.#ask(worker, "Runtime.queryObjects", {
        prototypeObjectId: result.objectId,
      });
      const sum = await this.#ask(worker, "Runtime.callFunctionOn", {
        objectId: objects.objectId,
        functionDeclaration:
          "function () { return this.reduce((sum, { buffer }) => sum + buffer.byteLength, 0) }",
        returnByValue: true,
      });
      found.modules += sum.result.value;
    }
    return found;
  }

  /** Asks a worker. @param {string} sessionId @param {string} method @param {object} [params] @returns {Promise<any>} */
  async #ask(sessionId, method, params = {}) {
    const id = ++this.#asked;
    const answer = new Promise((resolve) => this.#waiting.set(id, resolve));
    const message = JSON.stringify({ id, method, params });
    await this.#page.send("Target.sendMessageToTarget", { sessionId, message });
    return await answer.finally(() => this.#waiting.delete(id));
  }
}

/** @param {Heap} heap */
function bytes({ usedSize, embedderHeapUsedSize, backingStorageSize }) {
  return usedSize + embedderHeapUsedSize + backingStorageSize;
}
