/** What the page asks of its service worker. */
export type Asked =
  /** Keep what offline work needs and was not kept when the worker was installed: the module. */
  | "keep"
  /** Replace the version before, which runs in the window that asks. */
  | "take over";

/** What the service worker answers. */
export type Answered =
  /** All that the page needs without a network is kept. */
  | "kept"
  /** The version before runs in other windows, too, which would be left with parts of both. */
  | "others";
