export const engine = {
  starting: "Starting",
  loading: "Loading",
  loadingPercent: (percent: number) => `Loading ${percent} %`,
  ready: { gpu: "Ready on the GPU", cpu: "Ready on the CPU" },
  /** Why the processor computes, in place of the estimator's own words, which are English. */
  notices: {} as Readonly<Record<string, string>>,
};
