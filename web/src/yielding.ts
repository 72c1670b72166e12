/** Longest stretch without a look at the event loop, in milliseconds. */
const STRETCH = 20;

let channel: MessageChannel | undefined;
let last = 0;

/** Lets the event loop run, where messages (a cancel) wait; returns at once when it just had its turn. */
export async function yieldToEvents(): Promise<void> {
  if (performance.now() - last < STRETCH) return;
  await new Promise<void>(turn);
  last = performance.now();
}

function turn(resolve: () => void): void {
  if (typeof globalThis.setImmediate === "function") {
    // Node.js: an open channel would keep the program from ending.
    globalThis.setImmediate(resolve);
    return;
  }
  // A timer would wait for at least four milliseconds.
  channel ??= new MessageChannel();
  channel.port1.onmessage = () => resolve();
  channel.port2.postMessage(null);
}
