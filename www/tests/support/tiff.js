/**
 * A matte ball under some lamps, one a page: 16-bit grey TIFF without compression, drawn by formula.
 * @param {string} name
 * @param {number} side width and height in pixels
 * @param {[number, number][]} lamps x and y of each lamp's direction, of unit length with a positive z
 */
export function tiffPages(name, side, lamps) {
  const picture = side * side * 2;
  const entries = 10;
  const page = picture + 2 + entries * 12 + 4;
  const bytes = new DataView(new ArrayBuffer(8 + lamps.length * page));
  // "II", 42: the bytes of a number come with the lowest first.
  bytes.setUint16(0, 0x4949, true);
  bytes.setUint16(2, 42, true);
  bytes.setUint32(4, 8 + picture, true);
  lamps.forEach((lamp, index) => {
    const start = 8 + index * page;
    for (let y = 0; y < side; y += 1) {
      for (let x = 0; x < side; x += 1)
        bytes.setUint16(start + 2 * (y * side + x), ball(x, y, side, lamp), true);
    }
    let at = start + picture;
    bytes.setUint16(at, entries, true);
    at += 2;
    const [short, long] = [3, 4];
    for (const [tag, kind, value] of /** @type {[number, number, number][]} */ ([
      [256, long, side],
      [257, long, side],
      [258, short, 16],
      // No compression; black is 0; grey.
      [259, short, 1],
      [262, short, 1],
      [273, long, start],
      [277, short, 1],
      [278, long, side],
      [279, long, picture],
      [339, short, 1],
    ])) {
      bytes.setUint16(at, tag, true);
      bytes.setUint16(at + 2, kind, true);
      bytes.setUint32(at + 4, 1, true);
      if (kind === short) bytes.setUint16(at + 8, value, true);
      else bytes.setUint32(at + 8, value, true);
      at += 12;
    }
    const last = index === lamps.length - 1;
    bytes.setUint32(at, last ? 0 : start + page + picture, true);
  });
  return { name, bytes: new Uint8Array(bytes.buffer) };
}

/** @param {number} x @param {number} y @param {number} side @param {[number, number]} lamp */
function ball(x, y, side, [lampX, lampY]) {
  const radius = 0.42 * side;
  const [right, up] = [(x + 0.5 - side / 2) / radius, (side / 2 - y - 0.5) / radius];
  const square = right * right + up * up;
  if (square >= 1) return 0;
  const lampZ = Math.sqrt(1 - lampX * lampX - lampY * lampY);
  const shading = right * lampX + up * lampY + Math.sqrt(1 - square) * lampZ;
  return Math.round(50_000 * Math.max(shading, 0.01));
}
