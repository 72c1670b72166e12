import type { Notice } from "normalight";

/** What is said on the thumbnail of a file; notices that are about the whole stack stand in the list alone. */
const WORDS: Partial<{ [Kind in Notice["kind"]]: (notice: Extract<Notice, { kind: Kind }>) => string }> = {
  "content-over-extension": ({ content }) => `in truth ${content}`,
  "several-pages": ({ page, pages }) => `page ${page} of ${pages} is taken`,
  animation: () => "of an animation the first picture is taken",
  "several-layers": ({ taken }) => `layer ${taken} is taken`,
  "extra-channels": () => "further channels are left out",
  infinite: () => "has infinite values",
  "not-numbers": () => "has values that are no numbers",
  orientations: () => "turned as its camera noted",
  "profile-not-understood": () => "its colour profile is not understood",
  "nearly-identical": () => "nearly the same as another photograph",
  black: () => "black",
  saturated: () => "overexposed",
  "room-lit": () => "lit by the room rather than the lamp",
  "ambient-brighter": () => "darker than the room's light",
  "camera-moved": () => "the camera had moved",
  unlike: () => "unlike the others",
};

/** What is to be said of each file, by its name. */
export function noticesByFile(notices: readonly Notice[]): Map<string, string> {
  const said = new Map<string, string>();
  for (const notice of notices) {
    const words = WORDS[notice.kind] as ((notice: Notice) => string) | undefined;
    if (!words) continue;
    const files = "files" in notice ? notice.files : "file" in notice ? [notice.file] : [];
    for (const file of files) said.set(file, [said.get(file), words(notice)].filter(Boolean).join("; "));
  }
  return said;
}
