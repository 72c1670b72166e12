import assert from "node:assert/strict";

/**
 * Mean angle in degrees between the normals of two `.npy` files, over the pixels of the first's object.
 * @param {Uint8Array} expected @param {Uint8Array} found
 */
export function normalDifference(expected, found) {
  const [a, b] = [numbers(expected), numbers(found)];
  assert.equal(a.header, b.header);
  let [sum, pixels] = [0, 0];
  for (let at = 0; at < a.values.length; at += 3) {
    const [first, second] = [a.values.subarray(at, at + 3), b.values.subarray(at, at + 3)];
    const outside = first.every((value) => value === 0);
    assert.equal(
      second.every((value) => value === 0),
      outside,
      "the objects differ",
    );
    if (outside) continue;
    sum += angle(first, second);
    pixels += 1;
  }
  assert.ok(pixels > 100, `only ${pixels} pixels of an object`);
  return sum / pixels;
}

/**
 * Mean angle in degrees between the lights of two `lights.csv`, and the largest difference of intensities.
 * @param {Uint8Array} expected @param {Uint8Array} found
 */
export function lightDifference(expected, found) {
  const [a, b] = [lights(expected), lights(found)];
  assert.deepEqual(
    b.map(({ file }) => file),
    a.map(({ file }) => file),
  );
  const pairs = a.map((light, index) => ({ light, other: b[index] ?? light }));
  const angles = pairs.map(({ light, other }) => angle(light.direction, other.direction));
  return {
    degrees: angles.reduce((sum, value) => sum + value, 0) / angles.length,
    intensity: Math.max(...pairs.map(({ light, other }) => Math.abs(light.intensity - other.intensity))),
  };
}

/** @param {Uint8Array} bytes */
function lights(bytes) {
  const [header, ...rows] = new TextDecoder().decode(bytes).trim().split("\n");
  assert.equal(header, "file,x,y,z,intensity,confidence");
  return rows.map((row) => {
    const [file, ...values] = row.split(",");
    const [x = 0, y = 0, z = 0, intensity = 0] = values.map(Number);
    return { file, direction: [x, y, z], intensity };
  });
}

/** @param {Uint8Array} bytes */
function numbers(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const start = 10 + view.getUint16(8, true);
  const values = new Float32Array(bytes.slice(start).buffer);
  return { header: new TextDecoder().decode(bytes.subarray(10, start)).trim(), values };
}

/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
function angle(a, b) {
  const [[x1, y1, z1], [x2, y2, z2]] = [three(a), three(b)];
  const cross = Math.hypot(y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2);
  return (Math.atan2(cross, x1 * x2 + y1 * y2 + z1 * z2) * 180) / Math.PI;
}

/** @param {ArrayLike<number>} values @returns {[number, number, number]} */
function three(values) {
  return [values[0] ?? 0, values[1] ?? 0, values[2] ?? 0];
}

/** For JSON.parse: numbers without the digits in which processors differ. @param {string} _key @param {unknown} value */
export const rounded = (_key, value) => (typeof value === "number" ? Number(value.toPrecision(4)) : value);
