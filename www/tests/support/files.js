import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { crc32, deflateSync } from "node:zlib";

/** @typedef {{ name: string, bytes: Uint8Array }} TestFile */

/** The native command, which the page is compared with. */
function commandLine() {
  const path = process.env.NORMALIGHT_CLI;
  if (!path) throw new Error("NORMALIGHT_CLI names no command");
  return path;
}

/** The golden stack with its mask, and what the native command makes of it. */
export function goldenStack() {
  const folder = mkdtempSync(join(tmpdir(), "normalight-page-"));
  try {
    const [stack, results] = [join(folder, "stack"), join(folder, "results")];
    // Cargo puts the programs of a workspace side by side.
    const suffix = process.platform === "win32" ? ".exe" : "";
    execFileSync(join(dirname(commandLine()), `golden_stack${suffix}`), [stack]);
    execFileSync(commandLine(), ["estimate", stack, "--out", results, "--device", "cpu", "--quiet"]);
    return {
      files: filesIn(stack),
      results: new Map(filesIn(results).map(({ name, bytes }) => [name, bytes])),
    };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** @param {string} folder @returns {TestFile[]} */
function filesIn(folder) {
  return readdirSync(folder).map((name) => ({ name, bytes: readFileSync(join(folder, name)) }));
}

/**
 * A grey PNG of one value.
 * @param {string} name @param {number} width @param {number} height @param {number} value
 * @returns {TestFile}
 */
export function greyPng(name, width, height, value) {
  const row = Buffer.alloc(width + 1, value);
  row[0] = 0;
  return { name, bytes: pngOf(width, height, deflateSync(Buffer.concat(Array(height).fill(row)))) };
}

/**
 * A PNG whose header promises more pixels than anyone has.
 * @param {string} name @returns {TestFile}
 */
export function hugePng(name) {
  return { name, bytes: pngOf(20_000, 20_000, deflateSync(Buffer.alloc(100))) };
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
