/**
 * What went wrong, roughly: `input` for files or settings that do not do (the message names the file), `device` for a
 * GPU or a module that fails, `crashed` for a mistake of this program, after which it starts anew by itself, and `closed`
 * after `close()`.
 */
export type ErrorKind = "input" | "device" | "crashed" | "closed";

/**
 * What went wrong, more finely than {@link ErrorKind}: of `device`, `load` is a worker or a module that is missing, damaged
 * or half fetched, and `unsupported` a surrounding in which this package cannot work.
 */
export type ErrorCode = ErrorKind | "load" | "unsupported";

/** A failure of this package, with a message for people. */
export class NormalightError extends Error {
  override readonly name = "NormalightError";
  /** For programs. */
  readonly code: ErrorCode;

  constructor(code: ErrorCode, message: string) {
    super(message);
    this.code = code;
  }

  /** For programs that need no more. */
  get kind(): ErrorKind {
    return this.code === "load" || this.code === "unsupported" ? "device" : this.code;
  }
}

/** The words of whatever was thrown. */
export function messageOf(error: unknown): string {
  const { message } = Object(error) as { message?: unknown };
  return typeof message === "string" ? message : String(error);
}
