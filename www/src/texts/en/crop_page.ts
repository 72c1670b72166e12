export const cropPage = {
  open: "Crop…",
  remove: "Take the whole frame",
};
