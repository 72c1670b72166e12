use super::Texture;
use crate::IoError;
use normalight_core::{DepthMesh, Vec3};
use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Header, PropertyAccess, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;

/// One vertex or triangle.
struct Element {
    position: Vec3,
    normal: Vec3,
    color: [u8; 3],
    corners: [u32; 3],
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Self {
            position: Vec3::ZERO,
            normal: Vec3::Z,
            color: [0; 3],
            corners: [0; 3],
        }
    }

    fn get_float(&self, name: &str) -> Option<f32> {
        Some(match name {
            "x" => self.position.x,
            "y" => self.position.y,
            "z" => self.position.z,
            "nx" => self.normal.x,
            "ny" => self.normal.y,
            "nz" => self.normal.z,
            _ => return None,
        })
    }

    fn get_uchar(&self, name: &str) -> Option<u8> {
        let channel = ["red", "green", "blue"].iter().position(|&c| c == name)?;
        Some(self.color[channel])
    }

    fn get_list_uint(&self, name: &str) -> Option<&[u32]> {
        (name == "vertex_indices").then_some(&self.corners[..])
    }
}

/// Binary, little endian.
pub(super) fn write(mesh: &DepthMesh, texture: Option<Texture<'_>>) -> Result<Vec<u8>, IoError> {
    let scalar = |name: &str, kind| PropertyDef::new(name.to_owned(), PropertyType::Scalar(kind));
    let mut vertex = ElementDef::new("vertex".to_owned());
    vertex.count = mesh.positions.len();
    for name in ["x", "y", "z", "nx", "ny", "nz"] {
        vertex.properties.add(scalar(name, ScalarType::Float));
    }
    for name in ["red", "green", "blue"]
        .iter()
        .filter(|_| texture.is_some())
    {
        vertex.properties.add(scalar(name, ScalarType::UChar));
    }
    let mut face = ElementDef::new("face".to_owned());
    face.count = mesh.triangles.len();
    face.properties.add(PropertyDef::new(
        "vertex_indices".to_owned(),
        PropertyType::List(ScalarType::UChar, ScalarType::UInt),
    ));
    let mut header = Header::new();
    header.encoding = Encoding::BinaryLittleEndian;
    header.elements.add(vertex.clone());
    header.elements.add(face.clone());

    let failed = |error: std::io::Error| IoError::Encode {
        name: "PLY mesh",
        reason: error.to_string(),
    };
    let writer = Writer::<Element>::new();
    let mut bytes = Vec::with_capacity(27 * vertex.count + 13 * face.count + 512);
    writer.write_header(&mut bytes, &header).map_err(failed)?;
    let mut element = Element::new();
    for (index, &position) in mesh.positions.iter().enumerate() {
        element.position = position;
        element.normal = mesh.normals[index];
        if let Some(texture) = texture {
            element.color = texture.pixels[mesh.pixels[index] as usize];
        }
        writer
            .write_little_endian_element(&mut bytes, &element, &vertex)
            .map_err(failed)?;
    }
    for &corners in &mesh.triangles {
        element.corners = corners;
        writer
            .write_little_endian_element(&mut bytes, &element, &face)
            .map_err(failed)?;
    }
    Ok(bytes)
}
