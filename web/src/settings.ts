import type { DerivedSettings, MapSettings, Settings } from "./generated.js";
import type { DeriveOptions, EstimateOptions } from "./types.js";

/** How the module is to estimate. */
export function settingsOf(options: EstimateOptions): Required<Settings> {
  return {
    color: options.color ?? "auto",
    mask: options.mask === "none" ? "none" : "auto",
    images: options.images,
    lightAxes: options.lightAxes ?? "x-right,y-up,z-out",
    align: options.align ?? false,
    ambient: options.ambient ?? "none",
    normalFormat: options.normalFormat ?? "opengl",
    refit: options.refit ?? true,
    quality: options.quality ?? "default",
  };
}

/** What the module is to make of normals. */
export function derivedSettings(options: DeriveOptions): DerivedSettings {
  const { focal, maps = false } = options;
  return {
    depth: {
      projection: focal === undefined ? "orthographic" : { perspective: { focal } },
      integration: "bilateral",
    },
    flatten: options.flatten ?? false,
    heights: options.heights ?? false,
    mesh: options.mesh ?? null,
    triangles: options.triangles ?? 1_000_000,
    maps: maps === false ? null : mapSettings(maps === true ? {} : maps),
    tileable: options.tileable ?? false,
  };
}

function mapSettings(options: Exclude<DeriveOptions["maps"], boolean | undefined>): MapSettings {
  return {
    normal_format: options.normalFormat ?? "opengl",
    outside: options.outside ?? "flat",
    alpha: options.alpha ?? false,
    eight_bits: options.bits === 8,
  };
}
