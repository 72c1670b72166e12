import { decode } from "../relight/encoding.js";
import { Grid, type Relief, RIM } from "./grid.js";

/** A height field as a mesh: x right, y up, z to the camera; the longer side of the frame is 2 long. */
export interface HeightField {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  /** Linear. */
  readonly colours: Float32Array;
  readonly triangles: Uint32Array;
}

/** Every how many pixels there is a vertex, for so many vertices at most. */
export function stepFor(width: number, height: number, most: number): number {
  return Math.max(1, Math.ceil(Math.sqrt((width * height) / most)));
}

/** The mesh of a height field, inside the mask and not across its tears; it ends at a smooth line. */
export function heightField(relief: Relief, step: number): HeightField {
  const grid = new Grid(relief, step);
  const { columns, rows } = grid;
  const vertices = new Vertices(grid, relief);
  // Four triangles at most between four places: two, each in two parts.
  const triangles = new Uint32Array(12 * columns * rows);
  let length = 0;
  /** Adds what of a triangle lies inside. */
  const add = (a: number, b: number, c: number) => {
    const corners = vertices.inside(a, b, c);
    for (let last = 2; last < corners.length; last++) {
      triangles[length++] = corners[0] ?? 0;
      triangles[length++] = corners[last - 1] ?? 0;
      triangles[length++] = corners[last] ?? 0;
    }
  };
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const at = row * columns + column;
      const [right, lower] = [at + 1, at + columns];
      // Seen from the camera against the clock.
      if (grid.right(at) && grid.down(at)) add(at, lower, right);
      if (grid.right(lower) && grid.down(right)) add(right, lower, lower + 1);
    }
  }
  return { ...vertices.made(), triangles: triangles.slice(0, length) };
}

/** The vertices of a mesh: at places inside, and between places where the surface ends. */
class Vertices {
  readonly #insides: Float32Array;
  /** The vertex at each place; none yet where it is negative. */
  readonly #at: Int32Array;
  /** The vertices between two places, by both. */
  readonly #cuts = new Map<number, number>();
  /** Of which two pixels each vertex is, and how far it is on the way from one to the other. */
  readonly #from: number[] = [];
  readonly #to: number[] = [];
  readonly #shares: number[] = [];

  constructor(
    private readonly grid: Grid,
    private readonly relief: Relief,
  ) {
    this.#insides = grid.insides();
    this.#at = new Int32Array(this.#insides.length).fill(-1);
  }

  /** The corners of what of a triangle lies inside, in the same sense. */
  inside(...places: readonly [number, number, number]): number[] {
    const corners: number[] = [];
    for (let index = 0; index < 3; index++) {
      const [at = 0, next = 0] = [places[index], places[(index + 1) % 3]];
      const [here, there] = [this.#isInside(at), this.#isInside(next)];
      if (here) corners.push(this.#vertex(at));
      if (here !== there) corners.push(this.#cut(at, next));
    }
    return corners;
  }

  made(): Omit<HeightField, "triangles"> {
    const { width, height, depth, normals, albedo } = this.relief;
    const scale = 2 / Math.max(width, height);
    const { length } = this.#shares;
    const made = {
      positions: new Float32Array(3 * length),
      normals: new Float32Array(3 * length),
      colours: new Float32Array(3 * length),
    };
    for (let vertex = 0, to = 0; vertex < length; vertex++, to += 3) {
      const [one = 0, other = 0, share = 0] = [this.#from[vertex], this.#to[vertex], this.#shares[vertex]];
      const mixed = (a = 0, b = 0) => (1 - share) * a + share * b;
      const [x, y] = [mixed(one % width, other % width), mixed(rowOf(one, width), rowOf(other, width))];
      made.positions[to] = scale * (x + 0.5 - width / 2);
      made.positions[to + 1] = scale * (height / 2 - y - 0.5);
      made.positions[to + 2] = scale * mixed(depth[one], depth[other]);
      for (let axis = 0; axis < 3; axis++) {
        made.normals[to + axis] = mixed(normals[3 * one + axis], normals[3 * other + axis]);
        const [a, b] = [albedo[4 * one + axis] ?? 0, albedo[4 * other + axis] ?? 0];
        made.colours[to + axis] = mixed(decode(a), decode(b));
      }
    }
    return made;
  }

  #isInside(at: number): boolean {
    return (this.#insides[at] ?? 0) >= RIM;
  }

  #vertex(at: number): number {
    const before = this.#at[at] ?? -1;
    if (before >= 0) return before;
    const pixel = this.grid.pixel(at);
    const made = this.#new(pixel, pixel, 0);
    this.#at[at] = made;
    return made;
  }

  #cut(one: number, other: number): number {
    const [from, to] = one < other ? [one, other] : [other, one];
    const key = from * this.#at.length + to;
    const before = this.#cuts.get(key);
    if (before !== undefined) return before;
    const [a, b] = [this.#insides[from] ?? 0, this.#insides[to] ?? 0];
    const made = this.#new(this.grid.pixel(from), this.grid.pixel(to), (RIM - a) / (b - a));
    this.#cuts.set(key, made);
    return made;
  }

  #new(from: number, to: number, share: number): number {
    this.#from.push(from);
    this.#to.push(to);
    return this.#shares.push(share) - 1;
  }
}

function rowOf(pixel: number, width: number): number {
  return Math.floor(pixel / width);
}
