//! Meshes as shapes to render.
mod glb;
mod glb_accessors;
mod gltf_scene;
mod obj;
mod ply;
mod ply_elements;

use crate::IoError;
use crate::format::split_extension;
use crate::limits::{MAX_MESH_BYTES, MAX_MESH_VERTICES};
use normalight_core::{CoreError, MAX_TRIANGLES, TriangleMesh, Vec3};

/// The formats that are read, for messages.
pub(crate) const MESH_FORMATS: &str = "OBJ, PLY or GLB";

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MeshFormat {
    Obj,
    Ply,
    Glb,
}

/// Reads a mesh from memory: Wavefront OBJ, PLY (ascii or binary) or binary glTF, which one by the
/// name's extension.
///
/// All objects of a file become one mesh and polygons are cut into triangles around their first
/// corner. Normals, colours, textures and materials are ignored. Of a glTF file the default scene
/// is taken, with its nodes in place.
///
/// # Errors
/// [`IoError::NotAMesh`]; [`IoError::FileTooLarge`]; [`IoError::MeshFormat`] for a file that is
/// damaged or of a variant that is not read; [`IoError::ExternalBuffer`]; [`IoError::Mesh`] for
/// content that makes no surface.
pub fn read_mesh(name: &str, bytes: &[u8]) -> Result<TriangleMesh, IoError> {
    let format = mesh_format(name).ok_or_else(|| IoError::NotAMesh {
        name: name.to_owned(),
        found: format!("a file with extension {:?}", split_extension(name).1),
        expected: MESH_FORMATS,
    })?;
    if bytes.len() as u64 > MAX_MESH_BYTES {
        return Err(IoError::FileTooLarge {
            name: name.to_owned(),
            found: bytes.len() as u64,
            limit: MAX_MESH_BYTES,
        });
    }
    let Soup {
        positions,
        triangles,
    } = match format {
        MeshFormat::Obj => obj::read(name, bytes)?,
        MeshFormat::Ply => ply::read(name, bytes)?,
        MeshFormat::Glb => glb::read(name, bytes)?,
    };
    TriangleMesh::new(positions, triangles).map_err(|reason| wrong_mesh(name, reason))
}

/// The mesh format that a file's extension promises.
pub(crate) fn mesh_format(name: &str) -> Option<MeshFormat> {
    match split_extension(name).1.to_ascii_lowercase().as_str() {
        "obj" => Some(MeshFormat::Obj),
        "ply" => Some(MeshFormat::Ply),
        "glb" => Some(MeshFormat::Glb),
        _ => None,
    }
}

/// A mesh before it is checked.
#[derive(Default)]
struct Soup {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

fn wrong_mesh(name: &str, reason: CoreError) -> IoError {
    IoError::Mesh {
        name: name.to_owned(),
        reason,
    }
}

fn wrong_format(
    name: &str,
    format: &'static str,
    found: impl Into<String>,
    expected: impl Into<String>,
) -> IoError {
    // Decoders quote whole lines, which may be as long as the file.
    let found: String = found.into().chars().take(200).collect();
    IoError::MeshFormat {
        name: name.to_owned(),
        format,
        found: found.replace(char::is_control, " "),
        expected: expected.into(),
    }
}

/// Fails before anything is allocated for more vertices or triangles than are taken.
fn check_counts(
    name: &str,
    format: &'static str,
    vertices: usize,
    triangles: usize,
) -> Result<(), IoError> {
    if vertices > MAX_MESH_VERTICES {
        let expected = format!("at most {MAX_MESH_VERTICES}");
        return Err(wrong_format(
            name,
            format,
            format!("{vertices} vertices"),
            expected,
        ));
    }
    if triangles > MAX_TRIANGLES {
        let reason = CoreError::TooManyTriangles {
            found: triangles,
            allowed: MAX_TRIANGLES,
        };
        return Err(wrong_mesh(name, reason));
    }
    Ok(())
}
