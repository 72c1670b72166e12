/** Bytes that are copied at a time: a few milliseconds. */
const PIECE = 8e6;

/** Smaller arrays stay what they are. */
const SMALL = 1e5;

/** An array outside of this page's memory. */
interface Packed {
  readonly packed: Blob;
  readonly kind: "Float32Array" | "Uint8Array";
}

/** Bytes of the large arrays in a value of plain data. */
export function largeBytes(value: unknown): number {
  if (isLarge(value)) return value.byteLength;
  if (!isPlain(value)) return 0;
  return Object.values(value).reduce((sum: number, part) => sum + largeBytes(part), 0);
}

/** The same value with blobs for its large arrays: storing those does not stop the page. */
export async function pack(value: unknown): Promise<unknown> {
  if (isLarge(value)) {
    const pieces: Blob[] = [];
    for (let at = 0; at < value.byteLength; at += PIECE) {
      const length = Math.min(PIECE, value.byteLength - at);
      pieces.push(new Blob([new Uint8Array(value.buffer as ArrayBuffer, value.byteOffset + at, length)]));
      await breath();
    }
    const kind = value instanceof Float32Array ? "Float32Array" : "Uint8Array";
    return { packed: new Blob(pieces), kind } satisfies Packed;
  }
  return await eachPart(value, pack);
}

/** What was packed. */
export async function unpack(value: unknown): Promise<unknown> {
  const { packed, kind } = Object(value) as Partial<Packed>;
  if (packed instanceof Blob) {
    const bytes = await packed.arrayBuffer();
    return kind === "Float32Array" ? new Float32Array(bytes) : new Uint8Array(bytes);
  }
  return await eachPart(value, unpack);
}

async function eachPart(value: unknown, work: (part: unknown) => Promise<unknown>): Promise<unknown> {
  if (!isPlain(value)) return value;
  const parts: [string, unknown][] = [];
  for (const [name, part] of Object.entries(value)) parts.push([name, await work(part)]);
  return Array.isArray(value) ? parts.map(([, part]) => part) : Object.fromEntries(parts);
}

function isLarge(value: unknown): value is Float32Array | Uint8Array {
  return (value instanceof Float32Array || value instanceof Uint8Array) && value.byteLength > SMALL;
}

function isPlain(value: unknown): value is object {
  return Array.isArray(value) || Object.prototype.toString.call(value) === "[object Object]";
}

/** Lets the page do what waits. */
function breath(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}
