//! What is made of normals: depth, meshes, maps, another way for green.
use crate::error::Failure;
use crate::maps::FloatMap;
use js_sys::Uint8Array;
use normalight_io::{
    DerivedReport, DerivedSettings, NormalFormat, derived_files, normals_png, normals_rgba,
};
use serde::Serialize;
use tsify::{Ts, Tsify};
use wasm_bindgen::prelude::*;

/// A file that was made of normals.
#[derive(Debug, Serialize, Tsify)]
struct DerivedFile {
    /// File name.
    name: &'static str,
    /// Content.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint8Array<ArrayBuffer>")]
    bytes: Uint8Array,
}

/// What was made of normals.
#[derive(Debug, Serialize, Tsify)]
pub struct Derived {
    /// Heights in pixels towards the camera, one a pixel; NaN outside the object. The mean of each connected part is zero.
    depth: FloatMap,
    /// Files to keep; `depth.json` is the last.
    files: Vec<DerivedFile>,
    /// What is known of them.
    report: DerivedReport,
}

/// Normals as pictures.
#[derive(Debug, Serialize, Tsify)]
#[serde(rename_all = "camelCase")]
pub struct NormalPictures {
    /// 8-bit RGBA, transparent outside the object; rows from the top.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint8Array<ArrayBuffer>")]
    rgba: Uint8Array,
    /// `normals.png`, 16 bits.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint8Array<ArrayBuffer>")]
    png: Uint8Array,
}

/// Depth, and the files that are asked for, of normals (`[height, width, 3]`, zero outside the object); colours are those
/// of the albedo (likewise, linear).
///
/// # Errors
/// Maps of the wrong shape or without an object; what a file format cannot hold.
#[wasm_bindgen]
pub fn derive(
    normal_map: Ts<FloatMap>,
    albedo_map: Option<Ts<FloatMap>>,
    settings: Ts<DerivedSettings>,
) -> Result<Ts<Derived>, Failure> {
    let (normals, mask) = normal_map.to_rust()?.normals()?;
    let albedo = match albedo_map {
        Some(map) => Some(map.to_rust()?.planes("albedoMap")?),
        None => None,
    };
    let made = derived_files(&normals, albedo.as_deref(), &mask, settings.to_rust()?)?;
    let (heights, inside) = (made.depth.heights(), mask.inside());
    let height = |pixel: usize| {
        [if inside[pixel] {
            heights[pixel]
        } else {
            f32::NAN
        }]
    };
    let derived = Derived {
        depth: FloatMap::new(normals.width(), normals.height(), height),
        files: made
            .files
            .iter()
            .map(|(name, bytes)| DerivedFile {
                name,
                bytes: Uint8Array::from(bytes.as_slice()),
            })
            .collect(),
        report: made.report,
    };
    Ok(derived.into_ts()?)
}

/// Normals (`[height, width, 3]`, zero outside the object) as pictures in which green points as asked.
///
/// # Errors
/// A map of the wrong shape.
#[wasm_bindgen(js_name = normalPictures)]
pub fn normal_pictures(
    normal_map: Ts<FloatMap>,
    format: Ts<NormalFormat>,
) -> Result<Ts<NormalPictures>, Failure> {
    let (normals, _) = normal_map.to_rust()?.normals()?;
    let format = format.to_rust()?;
    let pictures = NormalPictures {
        rgba: Uint8Array::from(normals_rgba(&normals, format).as_slice()),
        png: Uint8Array::from(normals_png(&normals, format)?.as_slice()),
    };
    Ok(pictures.into_ts()?)
}
