//! Meshes of depth maps as files.
mod glb;
mod obj;
mod ply;

use crate::IoError;
use normalight_core::{CoreError, DepthMesh};
use serde::{Deserialize, Serialize};

/// Formats in which meshes are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum MeshFileFormat {
    /// Binary glTF with the texture inside; one metre is the width of the map.
    #[default]
    Glb,
    /// Wavefront OBJ, its material and its texture: three files; in pixels.
    Obj,
    /// Binary PLY with a colour for each vertex; in pixels.
    Ply,
}

/// Colours of a map's pixels as a viewer shows them.
#[derive(Debug, Clone, Copy)]
pub struct Texture<'a> {
    /// sRGB, rows from the top: `[height, width]` of the map.
    pub pixels: &'a [[u8; 3]],
    /// The same as PNG, for the formats that hold an image.
    pub png: &'a [u8],
}

/// A mesh as files (name, content), normals and texture coordinates included.
///
/// x right, y up, z to the camera; triangles counter-clockwise from the front.
///
/// # Errors
/// [`CoreError::SampleCount`] when the texture is not as large as the map; [`IoError::Encode`].
pub fn mesh_as_files(
    mesh: &DepthMesh,
    texture: Option<Texture<'_>>,
    format: MeshFileFormat,
) -> Result<Vec<(&'static str, Vec<u8>)>, IoError> {
    let expected = mesh.size[0] * mesh.size[1];
    if let Some(texture) = texture
        && texture.pixels.len() != expected
    {
        return Err(IoError::Core(CoreError::SampleCount {
            name: "texture".to_owned(),
            found: texture.pixels.len(),
            expected,
        }));
    }
    Ok(match format {
        MeshFileFormat::Glb => vec![("mesh.glb", glb::write(mesh, texture)?)],
        MeshFileFormat::Ply => vec![("mesh.ply", ply::write(mesh, texture)?)],
        MeshFileFormat::Obj => {
            let mut files = vec![("mesh.obj", obj::write(mesh, texture.is_some()))];
            if let Some(texture) = texture {
                files.push((obj::MATERIAL_FILE, obj::material()));
                files.push((obj::TEXTURE_FILE, texture.png.to_vec()));
            }
            files
        }
    })
}
