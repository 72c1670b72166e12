import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { crc32, deflateSync } from "node:zlib";

/** @typedef {{ name: string, bytes: Uint8Array }} TestFile */

/** The native command, which the page is compared with. */
function commandLine() {
  const path = process.env.NORMALIGHT_CLI;
  if (!path) throw new Error("NORMALIGHT_CLI names no command");
  return path;
}

/** The golden stack with its mask. @returns {TestFile[]} */
export function goldenStack() {
  return inScratch((folder) => {
    // Cargo puts the programs of a workspace side by side.
    const suffix = process.platform === "win32" ? ".exe" : "";
    execFileSync(join(dirname(commandLine()), `golden_stack${suffix}`), [folder]);
    return filesIn(folder);
  });
}

/** Where the samples lie that come with the page. */
const SAMPLES = fileURLToPath(new URL("../../public/samples/", import.meta.url));

/**
 * The samples that come with the page, as its list has them.
 * @returns {{ name: string, title: string, photographs: string[], mask: string, color: string }[]}
 */
export function sampleList() {
  return JSON.parse(readFileSync(join(SAMPLES, "samples.json"), "utf8"));
}

/** All files of a sample's folder. @param {string} name */
export function sampleFolder(name) {
  return filesIn(join(SAMPLES, name));
}

/**
 * What the native command makes of files.
 * @param {TestFile[]} files @param {string[]} options
 * @returns {Map<string, Uint8Array>}
 */
export function commandResults(files, ...options) {
  return inScratch((folder) => {
    const [stack, results] = [join(folder, "stack"), join(folder, "results")];
    mkdirSync(stack);
    for (const { name, bytes } of files) writeFileSync(join(stack, name), bytes);
    const settings = ["--device", "cpu", "--quiet", ...options];
    execFileSync(commandLine(), ["estimate", stack, "--out", results, ...settings]);
    return new Map(filesIn(results).map(({ name, bytes }) => [name, bytes]));
  });
}

/**
 * Works with the folder of a report: all methods on two small objects drawn for it, with two numbers of photographs.
 * @template T @param {(folder: string) => Promise<T>} work
 */
export async function withReport(work) {
  const folder = mkdtempSync(join(tmpdir(), "normalight-report-"));
  try {
    const [set, report] = [join(folder, "set"), join(folder, "report")];
    const size = ["--count", "2", "--images", "6", "--size", "48"];
    execFileSync(commandLine(), ["render", ...size, "--out", set, "--quiet"]);
    const measured = ["--methods", "all", "--images", "6,4", "--disturb", "encoded", "--quality", "fast"];
    // What some method cannot do is a part of the report, and its exit code says so.
    spawnSync(commandLine(), [
      "evaluate",
      set,
      ...measured,
      "--device",
      "cpu",
      "--report",
      report,
      "--quiet",
    ]);
    return await work(report);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Lends a folder that is gone afterwards. @template T @param {(folder: string) => T} work */
function inScratch(work) {
  const folder = mkdtempSync(join(tmpdir(), "normalight-page-"));
  try {
    return work(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** @param {string} folder @returns {TestFile[]} */
function filesIn(folder) {
  return readdirSync(folder).map((name) => ({ name, bytes: readFileSync(join(folder, name)) }));
}

/**
 * A grey PNG of one value, or of a ramp from half of it that rises along an axis, as a surface looks under a lamp, or of black
 * pixels and those of the value in turns.
 * @param {string} name @param {number} width @param {number} height @param {number} value
 * @param {"x" | "y" | "both" | "squares"} [lit]
 * @returns {TestFile}
 */
export function greyPng(name, width, height, value, lit) {
  /** @param {number} x @param {number} y */
  const share = (x, y) => ({
    x: x / width,
    y: y / height,
    both: (x / width + y / height) / 2,
    squares: 2 * ((x + y) % 2) - 1,
  });
  const rows = Array.from({ length: height }, (_, y) => {
    const row = Array.from({ length: width }, (_, x) => (lit ? (value / 2) * (1 + share(x, y)[lit]) : value));
    return Buffer.from([0, ...row]);
  });
  return { name, bytes: pngOf(width, height, deflateSync(Buffer.concat(rows))) };
}

/**
 * A mask as a portable grey map, a format that browsers do not decode.
 * @param {number} side @param {(x: number, y: number) => boolean} inside
 * @returns {TestFile}
 */
export function greyMapMask(side, inside) {
  const pixels = Uint8Array.from({ length: side * side }, (_, at) =>
    inside(at % side, Math.floor(at / side)) ? 255 : 0,
  );
  return { name: "mask.pgm", bytes: Buffer.concat([Buffer.from(`P5 ${side} ${side} 255\n`), pixels]) };
}

/** A mask with a square in its middle. @param {number} side @param {number} reach from the middle to a side of the square */
export function squareMask(side, reach) {
  const far = (/** @type {number} */ at) => Math.abs(at - side / 2);
  return greyMapMask(side, (x, y) => Math.max(far(x), far(y)) < reach);
}

/**
 * A PNG whose header promises more pixels than anyone has.
 * @param {string} name @returns {TestFile}
 */
export function hugePng(name) {
  return { name, bytes: pngOf(20_000, 20_000, deflateSync(Buffer.alloc(100))) };
}

/**
 * A zip of files as they are, without compression.
 * @param {string} name @param {TestFile[]} files @returns {TestFile}
 */
export function zipOf(name, files) {
  /** @type {Buffer[]} */
  const parts = [];
  /** @type {Buffer[]} */
  const directory = [];
  let offset = 0;
  for (const file of files) {
    const path = Buffer.from(file.name, "utf8");
    const about = Buffer.alloc(26);
    // Version 2.0, names in UTF-8, stored.
    about.writeUInt16LE(20, 0);
    about.writeUInt16LE(0x800, 2);
    about.writeUInt32LE(crc32(file.bytes), 10);
    about.writeUInt32LE(file.bytes.length, 14);
    about.writeUInt32LE(file.bytes.length, 18);
    about.writeUInt16LE(path.length, 22);
    const place = Buffer.alloc(14);
    place.writeUInt32LE(offset, 10);
    const local = Buffer.concat([Buffer.from("PK\x03\x04", "latin1"), about, path, Buffer.from(file.bytes)]);
    parts.push(local);
    directory.push(Buffer.from("PK\x01\x02\x14\x00", "latin1"), about, place, path);
    offset += local.length;
  }
  const list = Buffer.concat(directory);
  const end = Buffer.alloc(18);
  end.writeUInt16LE(files.length, 4);
  end.writeUInt16LE(files.length, 6);
  end.writeUInt32LE(list.length, 8);
  end.writeUInt32LE(offset, 12);
  return { name, bytes: Buffer.concat([...parts, list, Buffer.from("PK\x05\x06", "latin1"), end]) };
}

/** @param {number} width @param {number} height @param {Buffer} data */
function pngOf(width, height, data) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  // 8 bit grey; no interlacing.
  header.set([8, 0, 0, 0, 0], 8);
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([
    signature,
    chunk("IHDR", header),
    chunk("IDAT", data),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** @param {string} kind @param {Buffer} data */
function chunk(kind, data) {
  const body = Buffer.concat([Buffer.from(kind, "ascii"), data]);
  const ends = Buffer.alloc(8);
  ends.writeUInt32BE(data.length, 0);
  ends.writeUInt32BE(crc32(body), 4);
  return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
}
