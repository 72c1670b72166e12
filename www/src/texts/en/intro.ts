export const intro = {
  title: "The shape of a surface, from nothing but a moving lamp",
  photographs: "Photographs",
  photographsWhat: "of one object. Only the lamp moves, and nobody notes where it was.",
  lights: "Lights.",
  lightsWhat: "A network finds the direction and brightness of every lamp.",
  normals: "Normals.",
  normalsWhat: "A second one finds which way the surface faces, at every pixel.",
  promise: "Everything is computed on this computer. Your photographs never leave it.",
};
