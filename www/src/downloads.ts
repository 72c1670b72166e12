import type { Estimate, OutputName } from "normalight";
import { byId, make } from "./dom.js";

/** What each file is, in few words. */
const WORDS: Record<OutputName, string> = {
  "normals.png": "normal map, 16 bit",
  "normals.npy": "normals as numbers (NumPy)",
  "lights.csv": "lights as a table",
  "lights.lp": "lights for relighting programs",
  "lights.svg": "light map",
  "albedo.png": "colour without light",
  "mask.png": "the object's pixels",
  "report.json": "settings, device, seconds",
};

const TYPES: Record<string, string> = {
  png: "image/png",
  csv: "text/csv",
  svg: "image/svg+xml",
  json: "application/json",
};

let addresses: string[] = [];

/** Offers the files of a result; those of the result before are given up. */
export function showDownloads({ files }: Estimate): void {
  for (const address of addresses) URL.revokeObjectURL(address);
  const links = files.map(({ name, bytes }) => {
    const type = TYPES[name.split(".").pop() ?? ""] ?? "application/octet-stream";
    const link = make("a", "", make("b", "", name), make("span", "", `${WORDS[name]}, ${sizeOf(bytes)}`));
    link.href = URL.createObjectURL(new Blob([bytes], { type }));
    link.download = name;
    return link;
  });
  addresses = links.map(({ href }) => href);
  byId("downloads").replaceChildren(...links.map((link) => make("li", "", link)));
}

function sizeOf({ length }: Uint8Array): string {
  if (length < 1000) return `${length} bytes`;
  return length < 1e6 ? `${Math.round(length / 1000)} kB` : `${(length / 1e6).toFixed(1)} MB`;
}
