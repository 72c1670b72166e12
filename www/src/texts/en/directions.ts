/** From the right over the top, in eighths of a turn. */
const SIDES = ["right", "upper right", "top", "upper left", "left", "lower left", "bottom", "lower right"];

/** Where light comes from; sides are eighths of a turn, from the right over the top. */
export const directions = {
  left: "left",
  right: "right",
  beside: "beside the camera",
  above: (side: number, degrees: number) => `${SIDES[side]}, ${degrees}° above the picture`,
  straight: "straight from the camera",
  from: (side: number, degrees: number) => `${degrees}° from the camera, from the ${SIDES[side]}`,
};
