export const maskPage = {
  title: "Mask",
  wholeFrame: "Whole frame",
  file: "Mask image",
  draw: "Draw on the photograph…",
};
