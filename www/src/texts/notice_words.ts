import type { Notice } from "normalight";

export type NoticeKind = Notice["kind"];

/** A notice of one kind. */
export type NoticeOf<Kind extends NoticeKind> = Extract<Notice, { kind: Kind }>;

/** Words for some kinds of notices. */
export type FileNotices = Partial<{ [Kind in NoticeKind]: (notice: NoticeOf<Kind>) => string }>;
