import { browser } from "./browser.js";
import { Connection, type Follow, type WorkerLike } from "./connection.js";
import { NormalightError } from "./errors.js";
import type { FetchAsset } from "./fetch.js";
import type { Platform } from "./platform.js";
import { Aggregate } from "./progress.js";
import type { TaskName, Tasks } from "./protocol.js";
import { derivedSettings, settingsOf } from "./settings.js";
import { lightsFile, stackFile, stackFiles } from "./sources.js";
import type {
  ColorMode,
  CreateOptions,
  Derived,
  DeriveOptions,
  DeviceReport,
  Estimate,
  EstimateOptions,
  ImageSource,
  NormalFormat,
  NormalPictures,
  ObjectMask,
  Plan,
  StackFile,
  Surface,
  Thumbnail,
  UnpackedArchives,
} from "./types.js";

/**
 * Estimates lights and surface normals in a worker. Calls may overlap; they are done one after the other.
 *
 * ```ts
 * const normalight = await Normalight.create();
 * const { lights, files } = await normalight.estimate(input.files);
 * ```
 */
export class Normalight {
  /** What is done otherwise in Node.js. @internal */
  protected static readonly platform: Platform = browser;

  readonly #options: CreateOptions;
  readonly #platform: Platform;
  #connection: Connection | undefined;
  #device: DeviceReport | undefined;
  /** Why no GPU is asked for any more. */
  #gpuNotice: string | undefined;
  #queue: Promise<unknown> = Promise.resolve();
  #closed = false;

  /** @internal */
  protected constructor(options: CreateOptions, platform: Platform) {
    this.#options = options;
    this.#platform = platform;
  }

  /**
   * Loads the module with its networks and starts the device.
   *
   * @throws NormalightError, or the signal's reason when it was cancelled
   */
  static async create(options: CreateOptions = {}): Promise<Normalight> {
    // biome-ignore lint/complexity/noThisInStatic: Node.js has a subclass with another platform
    const normalight = new Normalight(options, this.platform);
    await normalight.#open(options.signal);
    return normalight;
  }

  /** What computes. */
  get device(): DeviceReport {
    if (this.#device === undefined) throw new NormalightError("closed", "no device was started");
    return this.#device;
  }

  /**
   * From photographs (3 or more, of one size, perhaps with a list and a mask) to lights and normals.
   *
   * @throws NormalightError, or the signal's reason when it was cancelled
   */
  estimate(images: Iterable<ImageSource>, options: EstimateOptions = {}): Promise<Estimate> {
    const { mask = "auto", lights, signal, onProgress, onPlan } = options;
    const { sendsFiles } = this.#platform;
    const settings = settingsOf(options);
    const aggregate = new Aggregate(settings.quality, settings.refit && lights === undefined);
    return this.#run(
      "estimate",
      async () => ({
        files: await stackFiles(images, sendsFiles),
        mask: typeof mask === "string" ? undefined : await stackFile(mask, "mask", sendsFiles),
        lights: lights === undefined ? undefined : await lightsFile(lights, sendsFiles),
        settings,
      }),
      {
        signal,
        onEvent(event) {
          if (event.event === "progress") onProgress?.(aggregate.at(event.stage, event.fraction));
          else if (event.event === "plan") onPlan?.(event.plan, event.words);
        },
      },
    );
  }

  /**
   * The mask that `estimate` would take of the same files and options, without estimating.
   *
   * @throws NormalightError, or the signal's reason when it was cancelled
   */
  mask(
    images: Iterable<ImageSource>,
    options: Pick<EstimateOptions, "align" | "ambient" | "color" | "images" | "mask" | "signal"> = {},
  ): Promise<ObjectMask> {
    const { mask = "auto", signal } = options;
    const { sendsFiles } = this.#platform;
    return this.#run(
      "mask",
      async () => ({
        files: await stackFiles(images, sendsFiles),
        mask: typeof mask === "string" ? undefined : await stackFile(mask, "mask", sendsFiles),
        settings: settingsOf(options),
      }),
      { signal },
    );
  }

  /**
   * Depth, meshes and maps of an estimate's normals, or of normals from elsewhere.
   *
   * @throws NormalightError for maps of the wrong shape or without an object
   */
  derive({ normalMap, albedoMap }: Surface, options: DeriveOptions = {}): Promise<Derived> {
    const request = { normals: normalMap, albedo: albedoMap, settings: derivedSettings(options) };
    return this.#run("derive", async () => request, { signal: options.signal });
  }

  /** Normals as pictures, green up (`opengl`) or down (`directx`): `normals.png` and 8-bit RGBA. */
  normalPictures({ normalMap }: Surface, format: NormalFormat): Promise<NormalPictures> {
    return this.#run("pictures", async () => ({ normals: normalMap, format }));
  }

  /** Which of the files are the photographs, in which order, and which is the mask. */
  plan(files: Iterable<ImageSource>): Promise<Plan> {
    return this.#run("plan", () => this.#files(files));
  }

  /**
   * The files in archives (zip, tar, tar.gz) where there are no photographs beside them; nothing where there are, or
   * no archive. `estimate` opens archives by itself: this is for who shows the photographs before.
   *
   * @throws NormalightError for a damaged or refused archive
   */
  async unpack(files: Iterable<ImageSource>): Promise<UnpackedArchives | undefined> {
    const unpacked = await this.#run("unpack", () => this.#files(files));
    if (unpacked === undefined) return undefined;
    const { archives, names } = unpacked;
    const named = (file: Blob, index: number) => new File([file], names[index] ?? "");
    return {
      archives,
      files: unpacked.files.map((file, index) => (file instanceof File ? file : named(file, index))),
    };
  }

  /** A photograph with its longer side brought down to `side` pixels; formats that browsers cannot show work too. */
  thumbnail(
    image: ImageSource,
    { color = "auto", side = 160, signal }: { color?: ColorMode; side?: number; signal?: AbortSignal } = {},
  ): Promise<Thumbnail> {
    const { sendsFiles } = this.#platform;
    const prepare = async () => ({ file: await stackFile(image, "image", sendsFiles), color, side });
    return this.#run("thumbnail", prepare, { signal });
  }

  /** Ends the worker and all calls; the object is of no use any more. */
  close(): void {
    this.#closed = true;
    this.#connection?.terminate(closed());
  }

  async #files(files: Iterable<ImageSource>): Promise<{ files: StackFile[] }> {
    return { files: await stackFiles(files, this.#platform.sendsFiles) };
  }

  /** Does a task when those before have ended; its request is made at once, because what it holds may change. */
  async #run<T extends TaskName>(
    task: T,
    prepare: () => Promise<Tasks[T]["request"]>,
    follow: Follow = {},
  ): Promise<Tasks[T]["response"]> {
    if (this.#closed) throw closed();
    const request = prepare();
    // It is looked at later; until then a failure is nobody's.
    request.catch(() => undefined);
    const turn = this.#queue.then(async () => {
      follow.signal?.throwIfAborted();
      const prepared = await request;
      const connection = await this.#open(follow.signal);
      try {
        return await connection.run(task, prepared, follow);
      } catch (error) {
        if (connection.gpuFault === undefined || this.#closed) throw error;
        return await (await this.#open(follow.signal)).run(task, prepared, follow);
      }
    });
    // A call that fails must not keep the next from its turn.
    this.#queue = turn.catch(() => undefined);
    return await turn;
  }

  /** The worker; a new one after a crash. */
  async #open(signal?: AbortSignal): Promise<Connection> {
    if (this.#closed) throw closed();
    if (this.#connection && !this.#connection.terminated) return this.#connection;
    return await this.#start(signal);
  }

  async #start(signal?: AbortSignal): Promise<Connection> {
    signal?.throwIfAborted();
    const fault = this.#connection?.gpuFault;
    if (fault !== undefined) this.#gpuNotice = `The GPU failed (${fault}), so the processor computes.`;
    const { device = "auto", onProgress, onLoad, threads, wasmUrl, weights, worker = true } = this.#options;
    const connection = new Connection(
      worker ? this.#platform.startWorker(this.#options) : await startHere(this.#platform.fetchAsset),
      this.#platform.advice(),
    );
    this.#connection = connection;
    connection.onDevice = (report) => this.#computesOn(report);
    const stop = () => connection.terminate(closed());
    // What loads hears nothing, and there is nothing yet that could be kept.
    signal?.addEventListener("abort", stop, { once: true });
    const { resolve } = this.#platform;
    try {
      const report = await connection.run(
        "create",
        {
          device: this.#gpuNotice === undefined ? device : "cpu",
          threads,
          wasmUrl: wasmUrl && resolve(wasmUrl),
          weights: weights && { light: resolve(weights.light), normal: resolve(weights.normal) },
        },
        {
          onEvent(event) {
            if (event.event !== "load") return;
            onProgress?.({ bytes: event.bytes, fraction: event.fraction });
            onLoad?.(event.fraction);
          },
        },
      );
      this.#computesOn(this.#gpuNotice === undefined ? report : { ...report, notice: this.#gpuNotice });
      signal?.throwIfAborted();
      return connection;
    } catch (error) {
      // Nobody else would end it: a failed `create` gives nothing that could be closed.
      connection.terminate(closed());
      signal?.throwIfAborted();
      throw error;
    } finally {
      signal?.removeEventListener("abort", stop);
    }
  }

  #computesOn(device: DeviceReport): void {
    const before = this.#device;
    this.#device = device;
    if (before !== undefined && before.kind !== device.kind) this.#options.onDevice?.(device);
  }
}

/** A worker that is none: in a file of its own, because who has workers does not need it. */
async function startHere(fetchAsset: FetchAsset): Promise<WorkerLike> {
  return (await import("./here.js")).startHere(fetchAsset);
}

function closed(): NormalightError {
  return new NormalightError("closed", "this estimator was closed");
}
