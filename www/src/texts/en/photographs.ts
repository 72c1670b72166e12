export const photographs = {
  bench: "Photographs and settings",
  title: "Photographs",
  drop: "Drop a folder or images here",
  dropWhat: "one object, one fixed camera, a lamp that moves; three or more",
  chooseImages: "Choose images",
  chooseFolder: "Choose folder",
  images: "Images of the stack",
  folder: "Folder of the stack",
  more: "More images",
  gone: "it is no longer among the files",
};
