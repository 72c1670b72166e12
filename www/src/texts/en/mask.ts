import type { Problem } from "../../mask/protocol.js";
import { fixed, whole } from "../numbers.js";
import { errors } from "./errors.js";

/** The mask editor, and the button that opens it. */
export const mask = {
  title: "Mask",
  noPhotographs: "Choose photographs first: the mask is drawn on them.",
  noPhotograph: "There is no photograph to draw a mask on.",

  undo: "Undo",
  undoTitle: "Takes back the last step (Ctrl Z)",
  redo: "Redo",
  redoTitle: "Does it again (Ctrl Shift Z)",
  done: "Done",
  doneTitle: "Takes this mask",
  cancel: "Cancel",
  cancelTitle: "Leaves the mask as it was",
  largerTitle: "Larger (plus key)",
  smallerTitle: "Smaller (minus key)",
  fit: "Fit",
  fitTitle: "The whole photograph (key 0)",
  actualTitle: "Pixel for pixel (key 1)",

  stage:
    "Photograph with the mask. Arrow keys move the brush, Space paints or sets a corner, Enter closes a polygon, plus and minus zoom.",

  tool: "Tool",
  tools: {
    brush: { words: "Brush", title: "Paints what belongs to the object; the right button erases" },
    eraser: { words: "Eraser", title: "Paints what does not belong to the object" },
    polygon: { words: "Polygon", title: "Adds what lies within corners; Enter or a double click closes" },
    cut: { words: "Cut out", title: "Removes what lies within corners" },
    move: { words: "Move", title: "Moves the photograph; the middle button does so with every tool" },
  },
  withKey: (title: string, key: string) => `${title} (key ${key})`,
  size: "Size",
  diameter: (pixels: number) => `${pixels} px`,

  byBrightness: "By brightness",
  brightness: "Brightness",
  percent: (percent: number) => `${percent} %`,
  side: "Which side is the object",
  brighter: "and brighter",
  darker: "and darker",
  take: "Take",
  takeTitle: "Takes all pixels of this brightness for the object",

  edge: "Edge",
  edgePixels: "Pixels to grow or shrink by",
  px: "px",
  grow: "Grow",
  growTitle: "Moves the edge outwards",
  shrink: "Shrink",
  shrinkTitle: "Moves the edge inwards",
  holes: "Fill holes",
  holesTitle: "Takes what is enclosed into the object",

  whole: "Whole mask",
  file: "Mask image",
  automatic: "Automatic",
  automaticTitle: "The mask that the estimator would take",
  load: "Load…",
  loadTitle: "A mask from a file",
  invert: "Invert",
  invertTitle: "Swaps inside and outside",
  frame: "Whole frame",
  frameTitle: "All pixels belong to the object",
  clear: "Clear",
  clearTitle: "No pixel belongs to the object",

  photograph: "Photograph",
  photographUnder: "Photograph under the mask",
  lightened: "lightened",

  looking: "Looking for the object …",
  loading: (file: string) => `Loading ${file} …`,
  loadingPhotograph: "Loading the photograph …",
  working: "Working …",
  writing: "Writing the mask …",
  noAutomatic: "There is no automatic mask here; by brightness comes close to it.",
  inside: (pixels: number, width: number, height: number) => {
    const share = fixed((100 * pixels) / (width * height), 1);
    const words = pixels === 0 ? "Nothing is inside: paint the object" : `${share} % inside`;
    return `${words}, ${whole(pixels)} of ${width} × ${height} pixels`;
  },
  leaving: "Escape once more leaves without these changes; Done keeps them.",

  closed: "The mask editor was closed.",
  stopped: (why: string) => `The mask editor's worker stopped: ${why}`,
  problem: (problem: Problem) => {
    switch (problem.kind) {
      case "shape": {
        const { mask, photograph } = problem;
        return `the mask has ${mask.width}x${mask.height} pixels, the photograph ${photograph.width}x${photograph.height}`;
      }
      case "canvas":
        return errors.noDrawing;
      case "other":
        return problem.words;
    }
  },
};
