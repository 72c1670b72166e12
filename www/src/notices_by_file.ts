import type { Notice } from "normalight";
import { texts } from "./texts/texts.js";

/** What is to be said of each file on its thumbnail, by its name. */
export function noticesByFile(notices: readonly Notice[]): Map<string, string> {
  const said = new Map<string, string>();
  for (const notice of notices) {
    const words = texts.fileNotices[notice.kind] as ((notice: Notice) => string) | undefined;
    if (!words) continue;
    const files = "files" in notice ? notice.files : "file" in notice ? [notice.file] : [];
    for (const file of files) said.set(file, [said.get(file), words(notice)].filter(Boolean).join("; "));
  }
  return said;
}
