export const solidPage = {
  title: "Surface in 3D",
  keys: "Drag or arrow keys turn the surface, wheel, pinch, + and − bring it nearer, 0 turns it back. The lamps are those of the relighting.",
};
