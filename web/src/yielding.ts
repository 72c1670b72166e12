/** Longest stretch without a look at the event loop, in milliseconds. */
const STRETCH = 20;

const channel = new MessageChannel();
let last = performance.now();

/** Lets the event loop run, where messages (a cancel) wait; returns at once when it just had its turn. */
export async function yieldToEvents(): Promise<void> {
  if (performance.now() - last < STRETCH) return;
  await new Promise<void>((resolve) => {
    // A timer would wait for at least four milliseconds.
    channel.port1.onmessage = () => resolve();
    channel.port2.postMessage(null);
  });
  last = performance.now();
}
