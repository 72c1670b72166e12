import type { ColorMode } from "normalight";
import { wordsOf } from "./dom.js";
import { texts } from "./texts/texts.js";

/** Where the samples and their list lie: beside the page. */
const FOLDER = new URL("samples/", document.baseURI);

/** A stack that comes with the page, as `samples.json` lists it. */
export interface Sample {
  /** The folder of its files. */
  readonly name: string;
  readonly title: string;
  /** What is special about it, in one line. */
  readonly description: string;
  /** How the values in its files relate to light. */
  readonly color: ColorMode;
  /** The photograph that stands for it. */
  readonly thumbnail: string;
  readonly mask: string;
  readonly photographs: readonly string[];
}

/** `missing`: the server does not have the file. `unreachable`: there was no whole answer. `broken`: it is no list. */
export type SampleErrorKind = "missing" | "unreachable" | "broken";

/** A file of a sample that cannot be had; the message names it. */
export class SampleError extends Error {
  override readonly name = "SampleError";
  readonly kind: SampleErrorKind;

  constructor(kind: SampleErrorKind, path: string, reason: string) {
    super(texts.samples.failed(path, reason));
    this.kind = kind;
  }
}

/** The samples that there are. */
export async function listSamples(): Promise<Sample[]> {
  const path = "samples.json";
  const list = await fetched(path);
  try {
    const samples = JSON.parse(await list.text()) as Sample[];
    return samples.map((sample) => ({ ...sample, ...texts.samples.words[sample.name] }));
  } catch (error) {
    throw new SampleError("broken", path, wordsOf(error));
  }
}

/** The address of the picture that stands for a sample. */
export function thumbnailOf({ name, thumbnail }: Sample): string {
  return new URL(`${name}/${thumbnail}`, FOLDER).href;
}

/**
 * The photographs and the mask of a sample, as if the user had chosen them.
 *
 * @param onProgress hears the share that has arrived
 */
export async function fetchSample(
  { name, mask, photographs }: Sample,
  signal: AbortSignal,
  onProgress: (fraction: number) => void,
): Promise<File[]> {
  const names = [...photographs, mask];
  // One file that fails makes the others useless.
  const failed = new AbortController();
  const either = AbortSignal.any([signal, failed.signal]);
  let arrived = 0;
  const files = names.map(async (file) => {
    const content = await fetched(`${name}/${file}`, either);
    arrived += 1;
    onProgress(arrived / names.length);
    return new File([content], file);
  });
  try {
    return await Promise.all(files);
  } catch (error) {
    failed.abort();
    throw error;
  }
}

async function fetched(path: string, signal?: AbortSignal): Promise<Blob> {
  let response: Response;
  let content: Blob;
  try {
    response = await fetch(new URL(path, FOLDER), signal ? { signal } : {});
    content = await response.blob();
  } catch (error) {
    signal?.throwIfAborted();
    throw new SampleError("unreachable", path, texts.samples.noConnection(wordsOf(error)));
  }
  if (!response.ok)
    throw new SampleError("missing", path, `${response.status} ${response.statusText}`.trim());
  // Some servers answer with a page of theirs instead of an error.
  if (content.type.startsWith("text/html")) throw new SampleError("missing", path, texts.samples.webPage);
  return content;
}
