import { byId, make, say, sayError } from "./dom.js";
import { texts } from "./texts/texts.js";

/** A file to keep. */
export interface Kept {
  readonly name: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

const TYPES: Record<string, string> = {
  png: "image/png",
  tiff: "image/tiff",
  csv: "text/csv",
  svg: "image/svg+xml",
  json: "application/json",
  glb: "model/gltf-binary",
  zip: "application/zip",
  html: "text/html",
};

/** The files of a result: those of the estimate, and those that were made of it since. */
export class Downloads {
  #name = "";
  #files: readonly Kept[] = [];
  #derived: readonly Kept[] = [];
  #addresses: string[] = [];
  #listing: ReturnType<typeof setTimeout> | undefined;
  /** A number that changes with the result. */
  #turn = 0;

  /** @param share makes the page that shows the object by itself */
  constructor(private readonly share: () => Promise<Kept>) {
    byId("zip").addEventListener("click", () => void this.#give(() => this.#zip()));
    byId("share").addEventListener("click", () => void this.#give(() => this.share()));
  }

  /** Offers the files of a result; those of the result before are given up. */
  show(files: readonly Kept[], name: string): void {
    this.#turn += 1;
    this.#name = name;
    this.#derived = [];
    this.#files = files;
    this.#list();
  }

  /** Offers files that were made of the result, in place of those that were made before. */
  add(derived: readonly Kept[]): void {
    this.#derived = derived;
    this.#list();
  }

  /** Offers normals in which green points another way; the report says so. */
  turn(normals: Uint8Array<ArrayBuffer>, format: string): void {
    const text = new TextEncoder();
    this.#files = this.#files.map(({ name, bytes }) => {
      if (name === "normals.png") return { name, bytes: normals };
      if (name !== "report.json") return { name, bytes };
      const report = new TextDecoder().decode(bytes);
      return { name, bytes: text.encode(withFormat(report, format)) };
    });
    this.#list();
  }

  /** Lists the files in a task of its own: copying them out of the page takes a while. */
  #list(): void {
    clearTimeout(this.#listing);
    this.#listing = setTimeout(() => this.#listNow());
  }

  #listNow(): void {
    for (const address of this.#addresses) URL.revokeObjectURL(address);
    const links = [...this.#files, ...this.#derived].map((file) => {
      const words = [texts.downloads.files[file.name], texts.downloads.size(file.bytes.length)]
        .filter(Boolean)
        .join(", ");
      const link = linkOf(file);
      link.append(make("b", "", file.name), make("span", "", words));
      return link;
    });
    this.#addresses = links.map(({ href }) => href);
    byId("downloads").replaceChildren(...links.map((link) => make("li", "", link)));
  }

  async #zip(): Promise<Kept> {
    const { zipOf } = await import("./out/zip.js");
    return { name: `${fileNameOf(this.#name)}.zip`, bytes: zipOf([...this.#files, ...this.#derived]) };
  }

  /** Makes a file and hands it to the browser to be stored. */
  async #give(made: () => Promise<Kept>): Promise<void> {
    const turn = this.#turn;
    const problem = byId("download-problem");
    say(problem, "");
    try {
      const file = await made();
      if (turn !== this.#turn) return;
      press(linkOf(file));
    } catch (error) {
      sayError(problem, error);
    }
  }
}

/** A report that names this way of green. */
export function withFormat(report: string, format: string): string {
  return report.replace(/("normal_format":\s*)"\w+"/, `$1"${format}"`);
}

/** A name for a file, of words that may hold anything. */
export function fileNameOf(words: string): string {
  const plain = words
    .normalize("NFC")
    .replace(/\.\w{2,4}\b/g, "")
    .replace(/[^\p{L}\p{N}._-]+/gu, "-")
    .replace(/^[-.]+|[-.]+$/g, "");
  return plain === "" ? "normalight" : plain.slice(0, 80);
}

/** Hands a file to the browser to be stored. */
export function store(name: string, content: Blob): void {
  press(linkTo(name, content));
}

function press(link: HTMLAnchorElement): void {
  link.click();
  // Browsers fetch what a link leads to some time after the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

function linkOf({ name, bytes }: Kept): HTMLAnchorElement {
  const type = TYPES[name.split(".").pop() ?? ""] ?? "application/octet-stream";
  return linkTo(name, new Blob([bytes], { type }));
}

function linkTo(name: string, content: Blob): HTMLAnchorElement {
  const link = make("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  return link;
}
