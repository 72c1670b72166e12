#!/usr/bin/env node
// The command of the package: `npx normalight estimate PHOTOS --out RESULT`.
import { parseArgs } from "node:util";
import { estimate } from "./bin-estimate.js";
import { NormalightError } from "./errors.js";

const USAGE = `Estimates lights and surface normals from photographs of one object under a moving lamp.

normalight estimate PHOTOS... --out DIR

PHOTOS is a folder of photographs, the photographs themselves, or an archive of them.

  --out DIR              folder for the results; made when missing
  --mask FILE|none       image of the object's pixels, or the whole frame
  --lights FILE          known lights
  --light-axes AXES      which way the axes of that file point, as in x-right,y-down,z-in
  --images N             use only this many photographs, evenly spaced
  --align                lay photographs that a moved camera took over the others
  --ambient auto         subtract a picture without lamp
  --color MODE           auto (default), linear or srgb
  --normal-format NAME   which way green points: opengl (default) or directx
  --no-refit             leave the first lights and normals as they are
  --quality NAME         fast, default or best
  --quiet                say nothing
  --help, --version

It computes on the processor. The command of normalight's repository is several times faster and can do more.
`;

/** Exit codes: nothing wrong, an error, wrong usage. */
const [DONE, FAILED, WRONG_USAGE] = [0, 1, 2];

async function main(): Promise<number> {
  let parsed: ReturnType<typeof parse>;
  try {
    parsed = parse();
  } catch (error) {
    return usage(error instanceof Error ? error.message : String(error));
  }
  const { values, positionals } = parsed;
  const [command, ...inputs] = positionals;
  if (values.version) {
    const { readFile } = await import("node:fs/promises");
    const text = await readFile(new URL("../package.json", import.meta.url), "utf8");
    console.log(`normalight ${JSON.parse(text).version}`);
    return DONE;
  }
  if (values.help || command === "help") {
    console.log(USAGE);
    return DONE;
  }
  if (command !== "estimate")
    return usage(command ? `there is no command ${command}` : "no command is given");
  if (inputs.length === 0) return usage("no photographs are given");
  if (values.out === undefined) return usage("--out is missing");
  try {
    await estimate(inputs, { ...values, out: values.out });
    return DONE;
  } catch (error) {
    const expected = error instanceof NormalightError || (error instanceof Error && "code" in error);
    console.error(`error: ${expected || !(error instanceof Error) ? (error as Error).message : error.stack}`);
    return FAILED;
  }
}

function parse() {
  return parseArgs({
    allowPositionals: true,
    options: {
      out: { type: "string" },
      mask: { type: "string" },
      lights: { type: "string" },
      "light-axes": { type: "string" },
      images: { type: "string" },
      align: { type: "boolean" },
      ambient: { type: "string" },
      color: { type: "string" },
      "normal-format": { type: "string" },
      "no-refit": { type: "boolean" },
      quality: { type: "string" },
      quiet: { type: "boolean" },
      help: { type: "boolean", short: "h" },
      version: { type: "boolean", short: "V" },
    },
  });
}

function usage(words: string): number {
  console.error(`error: ${words}\n\nnormalight --help says what there is`);
  return WRONG_USAGE;
}

process.exitCode = await main();
