import type { FileNotices } from "../notice_words.js";

/** What is said on the thumbnail of a file; notices that are about the whole stack stand in the list alone. */
export const fileNotices: FileNotices = {
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
