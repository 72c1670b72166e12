import type { Crop, Frame } from "../../crop/rectangle.js";

const pixels = ({ width, height }: Frame) => `${width} × ${height} pixels`;
const rectangle = (crop: Crop) => `${pixels(crop)}, ${crop.left} from the left and ${crop.top} from the top`;

/** The part of the photographs that is taken. */
export const crop = {
  title: "Crop",
  done: "Done",
  doneTitle: "Takes this part of all photographs",
  cancel: "Cancel",
  cancelTitle: "Leaves everything as it was",
  inPixels: "In pixels",
  numbers: { left: "Left", top: "Top", width: "Width", height: "Height" },
  whole: "Whole frame",
  wholeTitle: "Nothing is cut away",
  keys:
    "Drag on the photograph, or use the arrow keys: they move the rectangle, with Shift they change its size; " +
    "with Ctrl by single pixels. The same part of all photographs is taken, and of the mask.",
  /** The kind of control, for screen readers. */
  kind: "rectangle",
  box: "The part that is taken",
  rectangle,
  wholeFrame: (crop: Crop) => `The whole frame, ${pixels(crop)}`,
  taken: (crop: Crop, { width, height }: Frame) =>
    `Taken of all photographs: ${rectangle(crop)}, of ${width} × ${height}.`,
  begin: "Crop…",
  change: "Change the crop…",
  unknown: "It is not known yet which files are photographs.",
  fixed: (file: string, why: string) => `They can only be taken whole: ${file} ${why}.`,
};
