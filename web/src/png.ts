/** Pixels as they will lie in a PNG. */
export interface Pixels {
  /** In pixels. */
  readonly width: number;
  /** In pixels. */
  readonly height: number;
  /** Grey, grey and alpha, RGB, RGB and alpha. */
  readonly channels: 1 | 2 | 3 | 4;
  /** Row after row from the top; 8 or 16 bits each. */
  readonly data: Uint8Array | Uint8ClampedArray | Uint16Array;
  /** How the samples relate to light. */
  readonly colorSpace: "srgb" | "linear" | "display-p3";
}

/** PNG's number of a combination of channels. */
const COLOR_TYPES = { 1: 0, 2: 4, 3: 2, 4: 6 } as const;
const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
/** The most that a stored block of deflate can hold. */
const BLOCK = 0xffff;

/** What tells a reader how samples relate to light, so that nobody has to say it beside the file. */
const SAID: Record<Pixels["colorSpace"], [kind: string, content: number[]]> = {
  // Rendering intent: perceptual, which nobody looks at.
  srgb: ["sRGB", [0]],
  // Gamma 1, times 100000.
  linear: ["gAMA", [0x00, 0x01, 0x86, 0xa0]],
  // Primaries of P3, curve of sRGB, RGB, full range.
  "display-p3": ["cICP", [12, 13, 0, 1]],
};

/** A PNG of the pixels, not compressed: it is read again at once, on the same computer. */
export function encodePng(pixels: Pixels): Uint8Array<ArrayBuffer> {
  const { width, height, channels, colorSpace } = pixels;
  const depth = pixels.data instanceof Uint16Array ? 16 : 8;
  const header = new Uint8Array(13);
  const view = new DataView(header.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  header.set([depth, COLOR_TYPES[channels], 0, 0, 0], 8);
  const [kind, content] = SAID[colorSpace];
  const parts = [
    new Uint8Array(SIGNATURE),
    chunk("IHDR", header),
    chunk(kind, new Uint8Array(content)),
    chunk("IDAT", stored(rows(pixels))),
    chunk("IEND", new Uint8Array()),
  ];
  return joined(parts);
}

/** The rows, each after the number of its filter: none. */
function rows({ width, height, channels, data }: Pixels): Uint8Array<ArrayBuffer> {
  const samples = width * channels;
  const wide = data instanceof Uint16Array;
  const length = 1 + samples * (wide ? 2 : 1);
  const bytes = new Uint8Array(length * height);
  const view = new DataView(bytes.buffer);
  for (let row = 0; row < height; row++) {
    const line = data.subarray(row * samples, (row + 1) * samples);
    const start = row * length + 1;
    // PNG has the higher byte first.
    if (wide) for (const [index, sample] of line.entries()) view.setUint16(start + 2 * index, sample);
    else bytes.set(line, start);
  }
  return bytes;
}

/** A zlib stream whose blocks are stored. */
function stored(bytes: Uint8Array): Uint8Array<ArrayBuffer> {
  const blocks = Math.max(1, Math.ceil(bytes.length / BLOCK));
  const stream = new Uint8Array(2 + bytes.length + 5 * blocks + 4);
  stream.set([0x78, 0x01]);
  let at = 2;
  for (let block = 0; block < blocks; block++) {
    const part = bytes.subarray(block * BLOCK, (block + 1) * BLOCK);
    const length = part.length;
    stream.set(
      [Number(block === blocks - 1), length & 255, length >> 8, ~length & 255, (~length >> 8) & 255],
      at,
    );
    stream.set(part, at + 5);
    at += 5 + length;
  }
  new DataView(stream.buffer).setUint32(at, adler32(bytes));
  return stream;
}

function chunk(kind: string, content: Uint8Array): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(12 + content.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, content.length);
  for (let index = 0; index < 4; index++) bytes[4 + index] = kind.charCodeAt(index);
  bytes.set(content, 8);
  view.setUint32(8 + content.length, crc32(bytes.subarray(4, 8 + content.length)));
  return bytes;
}

/** The parts one after the other. */
export function joined(parts: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/** As RFC 1950 describes it; sums are kept small enough by reducing them now and then. */
function adler32(bytes: Uint8Array): number {
  let [a, b] = [1, 0];
  for (let start = 0; start < bytes.length; start += 3800) {
    const end = Math.min(start + 3800, bytes.length);
    for (let index = start; index < end; index++) {
      a += bytes[index] ?? 0;
      b += a;
    }
    a %= 65521;
    b %= 65521;
  }
  return ((b << 16) | a) >>> 0;
}

let table: Uint32Array | undefined;

/** As the PNG standard describes it, annex D. */
function crc32(bytes: Uint8Array): number {
  table ??= Uint32Array.from({ length: 256 }, (_, byte) => {
    let value = byte;
    for (let bit = 0; bit < 8; bit++) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
    return value;
  });
  let crc = 0xffffffff;
  for (const byte of bytes) crc = (table[(crc ^ byte) & 255] ?? 0) ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
}
