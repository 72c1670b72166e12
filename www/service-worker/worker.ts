// Keeps the page's files in the browser, so that it works without a network. A file is kept under its hash: what another
// version left is never taken for a file of this one.
import type { Answered, Asked } from "./messages.js";

/** The build's files by their paths, with their hashes as integrity metadata; the build puts them here. */
declare const __FILES__: Readonly<Record<string, string>>;

const FILES = __FILES__;
const worker = globalThis as unknown as ServiceWorkerGlobalScope;
const { scope } = worker.registration;

/** Caches belong to the whole origin, where other copies of the page may lie in other folders. */
const CACHE = `normalight ${scope}`;
const PAGE = "index.html";

/** Kept when they are first fetched: the files of samples, and the pictures that only the installing shows. */
const isExtra = (path: string) => /^(samples\/.+\/|icons\/)/.test(path);
/** Kept when it is first fetched or the page asks: nobody should wait for modules and weights who only looks at the page. */
const isModule = (path: string) => /\.(wasm|safetensors)$/.test(path);
/** Kept when it is first fetched: most of it all, and of use only where there is a GPU. */
const isForGpu = (path: string) => /normalight_gpu[^/]*\.wasm$/.test(path);

worker.addEventListener("install", (event) => event.waitUntil(install()));
worker.addEventListener("activate", (event) => event.waitUntil(activate()));
worker.addEventListener("fetch", (event) => {
  const path = pathOf(event.request);
  if (path !== undefined) event.respondWith(answer(path, event));
});
worker.addEventListener("message", (event) => event.waitUntil(hear(event)));

async function install(): Promise<void> {
  const kept = (await keptFiles()).map((address) => new URL(address).pathname);
  // Whoever works offline goes on to do so with a new version: its modules come with it.
  const [withModule, withGpu] = [kept.some(isModule), kept.some(isForGpu)];
  await keep((path) => !isExtra(path) && (isForGpu(path) ? withGpu : withModule || !isModule(path)));
}

/** Keeps those of the files that are not kept yet; fails when one cannot be had as the build has it. */
async function keep(wanted: (path: string) => boolean): Promise<void> {
  const cache = await caches.open(CACHE);
  const paths = Object.keys(FILES).filter(wanted);
  const fetched = paths.map(async (path) => {
    if (await cache.match(keyOf(path))) return;
    // Some servers answer `index.html` by sending browsers to its folder, whose answer browsers do not take for a page.
    const address = new URL(path === PAGE ? "./" : path, scope);
    const integrity = FILES[path] ?? "";
    // What the browser's own cache has is taken where the hash fits: no file is fetched twice on the first visit.
    const response = fetch(address, { cache: "force-cache", integrity });
    await cache.put(keyOf(path), await response.catch(() => fetch(address, { cache: "reload", integrity })));
  });
  await Promise.all(fetched);
}

/** From here on this version alone answers: what others left is deleted. */
async function activate(): Promise<void> {
  const cache = await caches.open(CACHE);
  const own = new Set(Object.keys(FILES).map(keyOf));
  for (const address of await keptFiles()) if (!own.has(address)) await cache.delete(address);
  await worker.clients.claim();
}

/** The path of a file of the build, which a request asks for. */
function pathOf({ method, url }: Request): string | undefined {
  const [address = ""] = url.split(/[?#]/);
  if (method !== "GET" || !address.startsWith(scope)) return undefined;
  const path = address.slice(scope.length) || PAGE;
  return Object.hasOwn(FILES, path) ? path : undefined;
}

async function answer(path: string, event: FetchEvent): Promise<Response> {
  const { request } = event;
  const cache = await caches.open(CACHE);
  // Who asks for it past every cache has found what is kept to be damaged.
  const kept = request.cache === "no-store" ? undefined : await cache.match(keyOf(path));
  if (kept) return kept;
  const response = await fetch(request);
  // Without room for it the page works all the same.
  if (response.status === 200)
    event.waitUntil(cache.put(keyOf(path), response.clone()).catch(() => undefined));
  return response;
}

async function hear({ data, source }: ExtendableMessageEvent): Promise<void> {
  const reply = (words: Answered) => source?.postMessage(words);
  if ((data as Asked) === "take over") {
    const windows = await worker.clients.matchAll({ type: "window", includeUncontrolled: true });
    if (windows.filter(({ url }) => url.startsWith(scope)).length > 1) reply("others");
    else await worker.skipWaiting();
    return;
  }
  try {
    await keep((path) => !isExtra(path) && !isForGpu(path));
    reply("kept");
  } catch {
    // No network or no room; the next visit asks again.
  }
}

function keyOf(path: string): string {
  return new URL(`${path}?${encodeURIComponent(FILES[path] ?? "")}`, scope).href;
}

async function keptFiles(): Promise<string[]> {
  return (await (await caches.open(CACHE)).keys()).map(({ url }) => url);
}
