import { mkdir, readdir, readFile, rename, rm, stat, writeFile } from "node:fs/promises";
import { basename, join } from "node:path";
import { NormalightError } from "./errors.js";
import { Normalight } from "./node.js";
import type { EstimateOptions, NamedFile } from "./types.js";

/** What was said on the command line. */
export interface EstimateArguments {
  readonly out: string;
  readonly mask?: string | undefined;
  readonly lights?: string | undefined;
  readonly "light-axes"?: string | undefined;
  readonly images?: string | undefined;
  readonly align?: boolean | undefined;
  readonly ambient?: string | undefined;
  readonly color?: string | undefined;
  readonly "normal-format"?: string | undefined;
  readonly "no-refit"?: boolean | undefined;
  readonly quality?: string | undefined;
  readonly quiet?: boolean | undefined;
}

/** Reads photographs, says what is taken for what, computes and writes the files. */
export async function estimate(inputs: readonly string[], said: EstimateArguments): Promise<void> {
  const options = await estimateOptions(said);
  const files = (await Promise.all(inputs.map(read))).flat();
  const say = (words: string) => said.quiet || console.log(words);
  const normalight = await Normalight.create();
  try {
    const estimate = await normalight.estimate(files, {
      ...options,
      onPlan: (_, words) => say(words.join("\n")),
    });
    await mkdir(said.out, { recursive: true });
    for (const { name, bytes } of estimate.files) await write(join(said.out, name), bytes);
    const seconds = estimate.seconds.reduce((sum, stage) => sum + stage.seconds, 0);
    say(`${estimate.files.length} files in ${said.out}, ${seconds.toFixed(1)} s`);
  } finally {
    normalight.close();
  }
}

/** The options of the package, as the command line says them; what it leaves out stays out. */
async function estimateOptions(said: EstimateArguments): Promise<EstimateOptions> {
  const images = said.images === undefined ? undefined : Number(said.images);
  if (images !== undefined && !(Number.isInteger(images) && images > 0)) {
    throw new NormalightError("input", `--images ${said.images}: not a number of photographs`);
  }
  const ambient = oneOf("ambient", said.ambient, ["none", "auto"]);
  const color = oneOf("color", said.color, ["auto", "linear", "srgb"]);
  const normalFormat = oneOf("normal-format", said["normal-format"], ["opengl", "directx"]);
  const quality = oneOf("quality", said.quality, ["fast", "default", "best"]);
  const { mask, lights, align } = said;
  const lightAxes = said["light-axes"];
  return {
    ...(mask !== undefined && { mask: mask === "none" ? mask : await readFileByName(mask) }),
    ...(lights !== undefined && { lights: await readFileByName(lights) }),
    ...(lightAxes !== undefined && { lightAxes }),
    ...(images !== undefined && { images }),
    ...(align !== undefined && { align }),
    ...(ambient !== undefined && { ambient }),
    ...(color !== undefined && { color }),
    ...(normalFormat !== undefined && { normalFormat }),
    ...(quality !== undefined && { quality }),
    refit: !said["no-refit"],
  };
}

function oneOf<const T extends string>(
  option: string,
  value: string | undefined,
  choices: readonly T[],
): T | undefined {
  if (value === undefined) return undefined;
  const choice = choices.find((name) => name === value);
  if (choice === undefined) {
    throw new NormalightError("input", `--${option} ${value}: must be one of ${choices.join(", ")}`);
  }
  return choice;
}

/** The file at a path, or the files in a folder. */
async function read(path: string): Promise<NamedFile[]> {
  if (!(await stat(path)).isDirectory()) return [await readFileByName(path)];
  const entries = await readdir(path, { withFileTypes: true });
  // What a system keeps for itself begins with a dot.
  const names = entries
    .filter((entry) => entry.isFile() && !entry.name.startsWith("."))
    .map(({ name }) => name);
  return await Promise.all(names.sort().map((name) => readFileByName(join(path, name))));
}

async function readFileByName(path: string): Promise<NamedFile> {
  return { name: basename(path), bytes: new Uint8Array(await readFile(path)) };
}

/** Under its name there is the whole file or none, whenever the program is ended. */
async function write(path: string, bytes: Uint8Array): Promise<void> {
  const aside = `${path}.${process.pid}.part`;
  try {
    await writeFile(aside, bytes);
    await rename(aside, path);
  } catch (error) {
    await rm(aside, { force: true });
    throw error;
  }
}
