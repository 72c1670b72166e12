import { Connection, type Follow } from "./connection.js";
import { NormalightError } from "./errors.js";
import { Aggregate } from "./progress.js";
import type { TaskName, Tasks } from "./protocol.js";
import { derivedSettings, settingsOf } from "./settings.js";
import type {
  ColorMode,
  CreateOptions,
  Derived,
  DeriveOptions,
  DeviceReport,
  Estimate,
  EstimateOptions,
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
  readonly #options: CreateOptions;
  #connection: Connection | undefined;
  #device: DeviceReport | undefined;
  #queue: Promise<unknown> = Promise.resolve();
  #closed = false;

  private constructor(options: CreateOptions) {
    this.#options = options;
  }

  /** Loads the module with its networks and starts the device. */
  static async create(options: CreateOptions = {}): Promise<Normalight> {
    const normalight = new Normalight(options);
    await normalight.#open();
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
  estimate(files: Iterable<StackFile>, options: EstimateOptions = {}): Promise<Estimate> {
    const { mask = "auto", lights, signal, onProgress, onPlan } = options;
    const settings = settingsOf(options);
    const aggregate = new Aggregate(settings.quality, settings.refit && lights === undefined);
    return this.#run(
      "estimate",
      {
        files: [...files],
        mask: typeof mask === "string" ? undefined : mask,
        lights,
        settings,
      },
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
    files: Iterable<StackFile>,
    options: Pick<EstimateOptions, "align" | "ambient" | "color" | "images" | "mask" | "signal"> = {},
  ): Promise<ObjectMask> {
    const { mask, signal } = options;
    const file = typeof mask === "string" ? undefined : mask;
    return this.#run("mask", { files: [...files], mask: file, settings: settingsOf(options) }, { signal });
  }

  /**
   * Depth, meshes and maps of an estimate's normals, or of normals from elsewhere.
   *
   * @throws NormalightError for maps of the wrong shape or without an object
   */
  derive({ normalMap, albedoMap }: Surface, options: DeriveOptions = {}): Promise<Derived> {
    const request = { normals: normalMap, albedo: albedoMap, settings: derivedSettings(options) };
    return this.#run("derive", request, { signal: options.signal });
  }

  /** Normals as pictures, green up (`opengl`) or down (`directx`): `normals.png` and 8-bit RGBA. */
  normalPictures({ normalMap }: Surface, format: NormalFormat): Promise<NormalPictures> {
    return this.#run("pictures", { normals: normalMap, format });
  }

  /** Which of the files are the photographs, in which order, and which is the mask. */
  plan(files: Iterable<StackFile>): Promise<Plan> {
    return this.#run("plan", { files: [...files] });
  }

  /**
   * The files in archives (zip, tar, tar.gz) where there are no photographs beside them; nothing where there are, or
   * no archive. `estimate` opens archives by itself: this is for who shows the photographs before.
   *
   * @throws NormalightError for a damaged or refused archive
   */
  unpack(files: Iterable<StackFile>): Promise<UnpackedArchives | undefined> {
    return this.#run("unpack", { files: [...files] });
  }

  /** A photograph with its longer side brought down to `side` pixels; formats that browsers cannot show work too. */
  thumbnail(
    file: StackFile,
    { color = "auto", side = 160, signal }: { color?: ColorMode; side?: number; signal?: AbortSignal } = {},
  ): Promise<Thumbnail> {
    return this.#run("thumbnail", { file, color, side }, { signal });
  }

  /** Ends the worker and all calls; the object is of no use any more. */
  close(): void {
    this.#closed = true;
    this.#connection?.terminate(closed());
  }

  async #run<T extends TaskName>(
    task: T,
    request: Tasks[T]["request"],
    follow: Follow = {},
  ): Promise<Tasks[T]["response"]> {
    const turn = this.#queue.then(async () => {
      follow.signal?.throwIfAborted();
      const connection = await this.#open();
      return await connection.run(task, request, follow);
    });
    // A call that fails must not keep the next from its turn.
    this.#queue = turn.catch(() => undefined);
    return await turn;
  }

  /** The worker; a new one after a crash. */
  async #open(): Promise<Connection> {
    if (this.#closed) throw closed();
    if (this.#connection && !this.#connection.terminated) return this.#connection;
    const { device = "auto" } = this.#options;
    try {
      return await this.#start(device);
    } catch (error) {
      const broken = error instanceof NormalightError && error.kind === "crashed";
      if (!broken || device === "cpu" || this.#closed) throw error;
      const connection = await this.#start("cpu");
      const notice = `WebGPU does not start (${error.message}), so the processor computes.`;
      this.#device = { ...this.device, notice };
      return connection;
    }
  }

  async #start(device: "auto" | "gpu" | "cpu"): Promise<Connection> {
    // A literal, so that bundlers find the worker and its parts.
    const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    const connection = new Connection(worker);
    this.#connection = connection;
    this.#device = await connection.run(
      "create",
      { device },
      { onEvent: (event) => event.event === "load" && this.#options.onLoad?.(event.fraction) },
    );
    return connection;
  }
}

function closed(): NormalightError {
  return new NormalightError("closed", "this estimator was closed");
}
