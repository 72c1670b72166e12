import type { OutputName } from "normalight";
import { fixed } from "../numbers.js";

const files: Record<OutputName, string> & Record<string, string> = {
  "normals.png": "normal map, 16 bit",
  "normals.npy": "normals as numbers (NumPy)",
  "lights.csv": "lights as a table",
  "lights.lp": "lights for relighting programs",
  "lights.svg": "light map",
  "albedo.png": "colour without light",
  "mask.png": "the object's pixels",
  "normals-error.png": "how far off normals may be: grey / 4 degrees",
  "normals-true-error.png": "how far off normals are: grey / 4 degrees",
  "report.json": "settings, device, seconds",
  "height.png": "depth, 16 bit grey",
  "height.tiff": "depth in pixels, float",
  "height.exr": "depth in pixels, float",
  "depth.json": "what the depth means",
  "map-normals.png": "normals for engines",
  "map-normals.exr": "normals as numbers",
  "map-height.png": "height for engines",
  "map-albedo.png": "albedo for engines",
  "map-curvature.png": "edges and hollows",
  "map-occlusion.png": "ambient occlusion",
  "mesh.glb": "surface for engines and viewers",
  "mesh.ply": "surface for mesh programs",
  "mesh.obj": "surface for any program",
  "mesh.mtl": "material of mesh.obj",
};

export const downloads = {
  title: "Download",
  zip: "All as one ZIP",
  share: "Relightable page",
  shareWhat: "One file that shows the object under a lamp in any browser, without network",
  /** What each file is, in few words. */
  files,
  size: (bytes: number) => {
    if (bytes < 1000) return `${bytes} bytes`;
    return bytes < 1e6 ? `${Math.round(bytes / 1000)} kB` : `${fixed(bytes / 1e6, 1)} MB`;
  },
};
