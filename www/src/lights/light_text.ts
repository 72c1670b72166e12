import { texts } from "../texts/texts.js";
import { directed, type HandLight } from "./light.js";

/** The header of our tables, as the estimator writes and reads them. */
const HEADER = "file,x,y,z,intensity,confidence";

const number = (value: number) => String(Number(value.toFixed(6)));

/** Lights as our table. */
export function toCsv(lights: readonly HandLight[]): string {
  const rows = lights.map(({ file, x, y, z, intensity, confidence }) =>
    [quoted(file), ...[x, y, z, intensity, confidence].map(number)].join(","),
  );
  return `${[HEADER, ...rows].join("\n")}\n`;
}

/** Lights for relighting programs: the count, then `name x y z` on each line. */
export function toLp(lights: readonly HandLight[]): string {
  const rows = lights.map(({ file, x, y, z }) => {
    const name = file.replace(/[\r\n]/g, " ");
    // A name of numbers alone, or one that begins as a comment does, would be read as such.
    const plain = !/^[#%]/.test(name) && name.split(/\s+/).some((word) => Number.isNaN(Number(word)));
    return `${plain ? name : `"${name}"`} ${[x, y, z].map((value) => value.toFixed(6)).join(" ")}`;
  });
  return `${[lights.length, ...rows].join("\n")}\n`;
}

export function toJson(lights: readonly HandLight[]): string {
  const axes = "x right, y up, z to the camera";
  return `${JSON.stringify({ axes, lights }, undefined, 2)}\n`;
}

/** Lights out of our table, an `.lp` or our JSON; other tables are the estimator's work. */
export function lightsOf(text: string, name: string): HandLight[] {
  const lights = /^\s*[[{]/.test(text) ? fromJson(text, name) : fromLines(text);
  if (lights.length === 0) throw new Error(texts.lights.noLights(name));
  return lights;
}

function fromJson(text: string, name: string): HandLight[] {
  let read: unknown;
  try {
    read = JSON.parse(text);
  } catch {
    throw new Error(texts.lights.noJson(name));
  }
  const list: unknown = Array.isArray(read) ? read : Object(read).lights;
  if (!Array.isArray(list)) throw new Error(texts.lights.noList(name));
  return list.map((one: unknown, index) => {
    const { file, x, y, z, intensity, confidence } = Object(one) as Record<string, unknown>;
    const light = lightFrom(String(file ?? index + 1), [x, y, z, intensity, confidence]);
    if (!light) throw new Error(texts.lights.noDirection(name, index + 1));
    return light;
  });
}

function fromLines(text: string): HandLight[] {
  const lines = text.split(/\r?\n/).filter((line) => line.trim() !== "" && !/^\s*[#%]/.test(line));
  const table = lines[0]?.trim().toLowerCase() === HEADER;
  return lines.flatMap((line, index) => {
    const words = table ? fields(line) : lpWords(line);
    const light = lightFrom(words[0] || String(index), words.slice(1));
    return light ? [light] : [];
  });
}

/** The name, which may hold spaces, and the three last words. */
function lpWords(line: string): string[] {
  const words = line.trim().split(/\s+/);
  const name = words
    .slice(0, -3)
    .join(" ")
    .replace(/^"(.*)"$/, "$1");
  return words.length < 3 ? [] : [name, ...words.slice(-3)];
}

function lightFrom(file: string, values: readonly unknown[]): HandLight | undefined {
  const [x, y, z, intensity, confidence] = values.map((value) =>
    value === "" || value === undefined || value === null ? Number.NaN : Number(value),
  );
  if (x === undefined || y === undefined || z === undefined) return undefined;
  const known = (value: number | undefined) => (value !== undefined && value >= 0 ? value : 1);
  const light = { file, x, y, z, intensity: known(intensity), confidence: known(confidence) };
  return directed(light, x, y, z);
}

function quoted(text: string): string {
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** The fields of a line, some of them in quotation marks. */
function fields(line: string): string[] {
  return [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map(([, inQuotes, plain]) =>
    inQuotes === undefined ? (plain ?? "").trim() : inQuotes.replaceAll('""', '"'),
  );
}
