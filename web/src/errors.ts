/**
 * What went wrong: `input` for files or settings that do not do (the message names the file), `device` for a
 * GPU or a module that fails, `crashed` for a mistake of this program, after which it starts anew by itself.
 */
export type ErrorKind = "input" | "device" | "crashed" | "closed";

/** A failure of this package, with a message for people. */
export class NormalightError extends Error {
  override readonly name = "NormalightError";
  readonly kind: ErrorKind;

  constructor(kind: ErrorKind, message: string) {
    super(message);
    this.kind = kind;
  }
}
