import { fixed } from "../numbers.js";

export const derive = {
  title: "Depth, mesh and maps",
  depth: "Depth (PNG, TIFF, EXR)",
  mesh: "Mesh",
  noMesh: "none",
  maps: "Maps for engines",
  flatten: "Flatten a nearly flat object",
  tileable: "Tileable maps",
  make: "Make",
  making: "Making the surface",
  made: (seconds: number, pixels: number, parts: number) => {
    const apart = parts === 1 ? "" : ` The object is in ${parts} parts, each with a height of its own.`;
    return `Made in ${fixed(seconds, 1)} s: ${fixed(pixels, 0)} pixels from back to front.${apart}`;
  },
};
