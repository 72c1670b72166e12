//! What is kept of the elements of a PLY file.
use normalight_core::Vec3;
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

/// A vertex; other properties than its place are dropped.
pub(super) struct Vertex(pub(super) Vec3);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self(Vec3::NAN)
    }

    fn set_property(&mut self, property_name: &str, property: Property) -> PropertyAccessResult {
        let component = match property_name {
            "x" => &mut self.0.x,
            "y" => &mut self.0.y,
            "z" => &mut self.0.z,
            _ => return PropertyAccessResult::Ignored,
        };
        let Some(value) = property.to_f32_lossy() else {
            return PropertyAccessResult::UnsupportedType;
        };
        *component = value;
        PropertyAccessResult::Set
    }
}

/// What the list of corners is called.
pub(super) const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The corners of a face.
pub(super) struct Face(pub(super) Vec<u32>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, property_name: &str, property: Property) -> PropertyAccessResult {
        if !FACE_LISTS.contains(&property_name) {
            return PropertyAccessResult::Ignored;
        }
        let Some(corners) = property.to_u32_list() else {
            return PropertyAccessResult::UnsupportedType;
        };
        self.0 = corners;
        PropertyAccessResult::Set
    }
}

/// An element that plays no part in the mesh.
pub(super) struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}
