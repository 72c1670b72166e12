import type { OutputName } from "normalight";
import type { downloads as en } from "../en/downloads.js";
import { fixed } from "../numbers.js";

const files: Record<OutputName, string> & Record<string, string> = {
  "normals.png": "Normalen als Bild, 16 Bit",
  "normals.npy": "Normalen als Zahlen (NumPy)",
  "lights.csv": "Lichter als Tabelle",
  "lights.lp": "Lichter für Relighting-Programme",
  "lights.svg": "Lichter als Zeichnung",
  "albedo.png": "Farbe ohne Licht",
  "mask.png": "die Pixel des Objekts",
  "normals-error.png": "wie falsch Normalen sein können: Grauwert / 4 Grad",
  "normals-true-error.png": "wie falsch Normalen sind: Grauwert / 4 Grad",
  "report.json": "Einstellungen, Gerät, Sekunden",
  "height.png": "Tiefe, 16 Bit grau",
  "height.tiff": "Tiefe in Pixeln, Gleitkomma",
  "height.exr": "Tiefe in Pixeln, Gleitkomma",
  "depth.json": "was die Tiefe bedeutet",
  "map-normals.png": "Normalen für Engines",
  "map-normals.exr": "Normalen als Zahlen",
  "map-height.png": "Höhe für Engines",
  "map-albedo.png": "Albedo für Engines",
  "map-curvature.png": "Kanten und Vertiefungen",
  "map-occlusion.png": "Umgebungsverdeckung",
  "mesh.glb": "Oberfläche für Engines und Betrachter",
  "mesh.ply": "Oberfläche für Netzprogramme",
  "mesh.obj": "Oberfläche für jedes Programm",
  "mesh.mtl": "Material von mesh.obj",
};

export const downloads: typeof en = {
  title: "Herunterladen",
  zip: "Alles als ein ZIP",
  share: "Beleuchtbare Seite",
  shareWhat: "Eine Datei, die das Objekt in jedem Browser unter einer Lampe zeigt, auch ohne Netzwerk",
  files,
  size: (bytes) => {
    if (bytes < 1000) return `${bytes} Byte`;
    return bytes < 1e6 ? `${Math.round(bytes / 1000)} kB` : `${fixed(bytes / 1e6, 1)} MB`;
  },
};
