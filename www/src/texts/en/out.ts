/** Files that are handed on: archives, and the page of one file. */
export const out = {
  tooLarge: "One archive of all would be larger than 4 GB: download the results one by one.",
  noPicture: "this browser cannot write the picture",
  /** The page of one file, which speaks the language of the page that made it. */
  page: {
    untitled: "Relightable object",
    /** The kind of control, for screen readers. */
    kind: "picture",
    object: "The object under a lamp",
    how: "Move the lamp: pointer, finger or arrow keys.",
    surface: "The surface",
    gloss: "Gloss",
    detail: "Detail",
    colours: "colours",
    unreadable: "This browser cannot read the pictures in this file.",
  },
};
