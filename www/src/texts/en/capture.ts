export const capture = {
  title: "How to photograph",
  many: "How many",
  manyWhat:
    "Ten to twenty, the lamp somewhere else for each. Sixteen are hardly worse than thirty-two; four are two thirds worse.",
  far: "How far",
  farWhat:
    "The lamp five times as far as the object is large, about the same distance each time; its light then comes from one direction everywhere.",
  camera: "Camera",
  cameraWhat: "On a stand, with fixed exposure, focus and white balance, and without flash.",
  room: "Room",
  roomWhat: "Dark. Otherwise take one more photograph without the lamp, and say which one it is.",
  around: "All around, some higher",
  oneSide: "From one side",
  besideCamera: "Beside the camera",
  grazing: "Grazing",
  good: "Every part of the object is lit from several sides.",
};
