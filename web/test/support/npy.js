import { readFile } from "node:fs/promises";

/** An array of float32 that NumPy would read. @param {string} path */
export async function readNpy(path) {
  const { buffer, byteOffset } = new Uint8Array(await readFile(path));
  const view = new DataView(buffer, byteOffset);
  const start = 10 + view.getUint16(8, true);
  const head = new TextDecoder().decode(new Uint8Array(buffer, byteOffset + 10, start - 10));
  const sides = head.match(/'descr': '<f4', 'fortran_order': False, 'shape': \(([^)]*)\)/)?.[1];
  if (sides === undefined) throw new Error(`${path} begins with ${head}`);
  const shape = sides.split(",").filter((side) => side.trim() !== "");
  return { shape: shape.map(Number), data: new Float32Array(buffer.slice(byteOffset + start)) };
}
