export const cropPage = {
  remove: "Take the whole frame",
};
