import assert from "node:assert/strict";
import { test } from "node:test";
import { inflateSync } from "node:zlib";
import { encodePng } from "../dist/png.js";
import { rawFile } from "../dist/raw.js";
import { lightsFile, stackFiles } from "../dist/sources.js";

/** The chunks of a PNG. @param {Uint8Array} png */
function chunks(png) {
  const view = new DataView(png.buffer);
  /** @type {Record<string, Uint8Array>} */
  const found = {};
  for (let at = 8; at < png.length; ) {
    const length = view.getUint32(at);
    found[String.fromCharCode(...png.subarray(at + 4, at + 8))] = png.subarray(at + 8, at + 8 + length);
    at += 12 + length;
  }
  return found;
}

test("a PNG has rows with their filter, and says how samples relate to light", () => {
  const image = /** @type {const} */ ({ width: 2, height: 2, channels: 1 });
  const eight = chunks(encodePng({ ...image, data: new Uint8Array([1, 2, 3, 4]), colorSpace: "srgb" }));
  assert.deepEqual([...inflateSync(eight.IDAT)], [0, 1, 2, 0, 3, 4]);
  assert.deepEqual([...eight.IHDR], [0, 0, 0, 2, 0, 0, 0, 2, 8, 0, 0, 0, 0]);
  assert.deepEqual([...eight.sRGB], [0]);
  const sixteen = chunks(
    encodePng({ ...image, data: new Uint16Array([1, 2, 3, 772]), colorSpace: "linear" }),
  );
  assert.deepEqual([...inflateSync(sixteen.IDAT)], [0, 0, 1, 0, 2, 0, 0, 3, 3, 4]);
  assert.equal(sixteen.IHDR[8], 16);
  assert.deepEqual([...sixteen.gAMA], [0, 1, 134, 160]);
});

test("a PNG of many blocks is whole", () => {
  const data = Uint8Array.from({ length: 300 * 200 * 3 }, (_, index) => index * 7);
  const png = encodePng({ width: 300, height: 200, channels: 3, data, colorSpace: "display-p3" });
  const rows = inflateSync(chunks(png).IDAT);
  assert.equal(rows.length, 200 * 901);
  assert.deepEqual(rows.subarray(901 + 1, 2 * 901), Buffer.from(data.subarray(900, 1800)));
});

test("floats become a float map with rows from the bottom", () => {
  const { name, bytes } = rawFile({ width: 1, height: 2, data: new Float32Array([0.5, 2]) }, "image_001");
  const head = "Pf\n1 2\n-1.0\n";
  assert.equal(name, "image_001.pfm");
  assert.equal(new TextDecoder().decode(bytes.subarray(0, head.length)), head);
  assert.deepEqual([...new Float32Array(bytes.slice(head.length).buffer)], [2, 0.5]);
});

test("samples that make no image are refused by name", () => {
  for (const [image, words] of [
    [{ width: 2, height: 2, data: new Uint8Array(5) }, /image_001: .*no image of 2 x 2 pixels/],
    [{ width: 2, height: 2, channels: 3, data: new Uint8Array(4) }, /12 samples, not 4/],
    [{ width: 1, height: 1, data: new Float32Array(3), colorSpace: "srgb" }, /floats must be linear/],
    [{ width: 1, height: 1, data: new Float32Array(4) }, /1 or 3 channels, not 4/],
    [{ width: 1, height: 1, data: new Float64Array(1) }, /Uint8Array, Uint8ClampedArray/],
  ]) {
    assert.throws(() => rawFile(/** @type {any} */ (image), "image_001"), { code: "input", message: words });
  }
});

test("whatever is handed over becomes files, with names by their places", async () => {
  const named = { name: "a.png", bytes: new Uint8Array([1]) };
  const files = await stackFiles(
    [
      new Uint8Array([2]).buffer,
      named,
      new Blob(["3"]),
      new File(["4"], "b.jpg"),
      { width: 1, height: 1, data: new Uint8Array(3) },
    ],
    false,
  );
  const names = files.map(({ name }) => name);
  assert.deepEqual(names, ["image_001", "a.png", "image_003", "b.jpg", "image_005.png"]);
  assert.ok(files.every((file) => "bytes" in file && file.bytes instanceof Uint8Array));
  await assert.rejects(stackFiles([/** @type {any} */ (5)], true), {
    code: "input",
    message: "image_001: Number is no image and no file",
  });
});

test("lights may be vectors or text", async () => {
  const text = async (/** @type {any} */ lights) => {
    const file = await lightsFile(lights, true);
    return "bytes" in file ? new TextDecoder().decode(file.bytes) : "";
  };
  assert.equal(
    await text([
      [0, 0.6, 0.8],
      [0, 0, 1],
    ]),
    "0 0.6 0.8\n0 0 1\n",
  );
  assert.equal(await text("0 0 1\n"), "0 0 1\n");
});
