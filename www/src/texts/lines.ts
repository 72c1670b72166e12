/** A line of a list for people. */
export interface Line {
  readonly words: string;
  /** Whether it tells of something doubtful. */
  readonly doubtful?: boolean;
  /** What follows the words in English, whatever the page speaks: the estimator wrote it. */
  readonly english?: string;
}

/** What begins a line of the estimator about something doubtful. */
const NOTICE = /^notice: /;

/** A line of the estimator; what is doubtful stands out. */
export function lineOf(words: string): Line {
  return { words: words.replace(NOTICE, ""), doubtful: NOTICE.test(words) };
}
