/**
 * @typedef {object} Event one of a trace; times in microseconds
 * @property {string} name
 * @property {string} ph
 * @property {number} pid
 * @property {number} tid
 * @property {number} ts
 * @property {number} [dur]
 * @property {number} [tdur] processor time of the thread
 * @property {{ name?: string }} [args]
 */

/** What a task may take, in milliseconds: people feel what is longer. */
export const LONGEST = 100;

/** What drawing a frame may take, in milliseconds: half of what there is at 60 a second. */
export const FRAME = 8;

/**
 * What a page's own thread did meanwhile, in milliseconds of processor time, which programs that keep the processor hardly
 * change: its tasks, what it took for a frame in all, and the page's own drawing of one.
 *
 * @param {import("playwright-core").Page} tab the only one of its browser
 * @param {() => Promise<unknown>} work
 */
export async function traced(tab, work) {
  const browser = tab.context().browser();
  if (!browser) throw new Error("this page has no browser of its own");
  await browser.startTracing(tab, {
    categories: ["toplevel", "devtools.timeline", "disabled-by-default-devtools.timeline"],
  });
  await work();
  /** @type {{ traceEvents: Event[] }} */
  const { traceEvents } = JSON.parse(String(await browser.stopTracing()));
  const mains = new Set(
    traceEvents
      .filter(({ name, args }) => name === "thread_name" && args?.name === "CrRendererMain")
      .map(({ pid, tid }) => `${pid} ${tid}`),
  );
  const own = traceEvents.filter(({ ph, pid, tid }) => ph === "X" && mains.has(`${pid} ${tid}`));
  const times = (/** @type {string} */ wanted) =>
    own.filter(({ name }) => name === wanted).map(({ tdur = Number.NaN }) => tdur / 1000);
  const [tasks, drawings] = [times("RunTask"), times("FireAnimationFrame")];
  const mean = (/** @type {number[]} */ all) => all.reduce((sum, one) => sum + one, 0) / drawings.length;
  return {
    tasks: tasks.length,
    longest: Math.max(...tasks),
    frames: drawings.length,
    frame: mean(tasks),
    drawing: mean(drawings),
  };
}
