import type { Side } from "../../lights/coverage.js";
import { fixed, percent } from "../numbers.js";

const count = (lights: number) => `${lights} lights`;

/** How sure a light is: numbers alone say little. */
const sureness = (confidence: number) => {
  if (confidence >= 0.75) return `sure, ${percent(confidence)} %`;
  return `${confidence >= 0.45 ? "fairly sure" : "doubtful"}, ${percent(confidence)} %`;
};

/** The lights of a result in the hand, and rigs. */
export const lights = {
  map: "Lights. Arrow keys choose one, with Shift they move it, Delete leaves its photograph out.",
  dot: (file: string, direction: string, intensity: number, confidence: number, leftOut: boolean) =>
    `${file}: ${direction}; intensity ${fixed(intensity, 2)}; ${sureness(confidence)}${leftOut ? "; left out" : ""}`,
  detail: (direction: string, confidence: number) => `${direction}; ${sureness(confidence)}`,
  fields: { x: "x", y: "y", z: "z", intensity: "intensity" },
  use: "use this photograph",
  leftOut: "left out",
  percent: (share: number) => `${percent(share)} %`,
  again: "Estimate normals again",
  undo: "Undo changes",
  changes: (changed: number, leftOut: number) =>
    [
      ...(changed > 0 ? [changed === 1 ? "1 light changed" : `${changed} lights changed`] : []),
      ...(leftOut > 0 ? [leftOut === 1 ? "1 photograph left out" : `${leftOut} photographs left out`] : []),
    ].join(", "),
  tooFew: "Three photographs at least must stay.",
  gone: "These photographs are no longer on the bench: choose them again first.",

  narrow: (degrees: number) =>
    `All lamps lie within ${degrees} degrees of one direction: move the lamp further, all around the object.`,
  noneOpposite: (side: Side) =>
    `All lamps came from the ${side}: the other side of the object is in shadow in every photograph.`,
  fewOpposite: (side: Side) =>
    `Nearly all lamps came from the ${side}: take more photographs with the lamp opposite.`,
  grazing:
    "The lamps graze the object: shadows cover much of it. Lift the lamp towards the camera, to about 45 degrees.",
  doubtful: (doubtful: number, of: number, names: readonly string[]) => {
    const more = doubtful > names.length ? " and others" : "";
    return `${doubtful} of ${of} lights are doubtful (${names.join(", ")}${more}): look at these photographs, or leave them out.`;
  },

  file: "File of lights",
  load: "Load…",
  loadTitle: "Lights from an .lp, our CSV or JSON",
  loaded: (file: string) => `Lights of ${file}: “Estimate normals again” uses them.`,
  save: (format: string) => `Save ${format}`,
  noLights: (file: string) => `${file}: no lights are found in it`,
  noJson: (file: string) => `${file}: it is not complete JSON`,
  noList: (file: string) => `${file}: expected a list of lights, or an object with "lights"`,
  noDirection: (file: string, number: number) => `${file}: light ${number} has no direction (x, y, z)`,
  otherCount: (lights: number, photographs: number) =>
    `There are ${lights} lights in the file and ${photographs} photographs.`,

  keepRig: "Keep as rig",
  keepRigTitle: "For the next object under the same lamps; stays in this browser",
  rigPlaceholder: "name of the rig",
  rigName: "Name of the rig",
  rigFirst: "Give the rig a name first.",
  rigKept: (name: string, lights: number) =>
    `Kept: ${name}, ${count(lights)}. Choose it under Lights for the next object.`,
  rig: (name: string, lights: number) => `${name} (${count(lights)})`,
  rigLacking: (name: string, lights: number, photographs: number) =>
    `The rig ${name} has ${count(lights)}, but there are ${photographs} photographs: each needs its light.`,
  rigUnnamed: "A rig needs a name.",
  rigTaken: (name: string) => `There is a rig ${name} already.`,
};
