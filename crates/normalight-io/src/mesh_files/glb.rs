use super::Texture;
use crate::IoError;
use normalight_core::{DepthMesh, Vec3};
use serde_json::{Value, json};

// Types of numbers and what buffers are for, as glTF counts them.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// The binary chunk and where its pieces lie.
#[derive(Default)]
struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
}

impl Binary {
    /// One more piece; gives its number.
    fn add(&mut self, piece: impl IntoIterator<Item = u8>, target: Option<u32>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(piece);
        let mut view = json!({
            "buffer": 0,
            "byteOffset": start,
            "byteLength": self.bytes.len() - start,
        });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        // Numbers of four bytes begin at multiples of four.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    fn add_floats(&mut self, numbers: impl Iterator<Item = f32>) -> usize {
        self.add(numbers.flat_map(f32::to_le_bytes), Some(VERTICES))
    }
}

/// Binary glTF 2.0 (Khronos, 2021): one mesh with normals and texture coordinates, one matte material.
pub(super) fn write(mesh: &DepthMesh, texture: Option<Texture<'_>>) -> Result<Vec<u8>, IoError> {
    let vertices = mesh.positions.len();
    let mut binary = Binary::default();
    let vectors = |of: &[Vec3]| of.iter().flat_map(|v| v.to_array()).collect::<Vec<f32>>();
    binary.add_floats(vectors(&mesh.positions).into_iter());
    binary.add_floats(vectors(&mesh.normals).into_iter());
    binary.add_floats((0..vertices).flat_map(|vertex| mesh.texture_place(vertex)));
    let corners = mesh.triangles.as_flattened().iter();
    binary.add(
        corners.flat_map(|corner| corner.to_le_bytes()),
        Some(INDICES),
    );
    let bounds = mesh
        .positions
        .iter()
        .fold((Vec3::MAX, Vec3::MIN), |(low, high), &place| {
            (low.min(place), high.max(place))
        });
    let accessor = |view: usize, kind: &str, component: u32, count: usize| json!({"bufferView": view, "type": kind, "componentType": component, "count": count});
    let mut position = accessor(0, "VEC3", FLOAT, vertices);
    position["min"] = bounds.0.to_array().into();
    position["max"] = bounds.1.to_array().into();
    let mut material = json!({
        "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 1.0},
        "doubleSided": true,
    });
    let metre = 1.0 / mesh.size[0].max(1) as f32;
    let mut document = json!({
        "asset": {"version": "2.0", "generator": "Normalight"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "scale": [metre, metre, metre]}],
        "meshes": [{"primitives": [{
            "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
            "indices": 3,
            "material": 0,
        }]}],
        "accessors": [
            position,
            accessor(1, "VEC3", FLOAT, vertices),
            accessor(2, "VEC2", FLOAT, vertices),
            accessor(3, "SCALAR", UNSIGNED_INT, 3 * mesh.triangles.len()),
        ],
    });
    if let Some(texture) = texture {
        let view = binary.add(texture.png.iter().copied(), None);
        material["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
        document["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
        // Beyond its edge the map does not go on from the other side.
        document["samplers"] = json!([{"wrapS": 33071, "wrapT": 33071}]);
        document["textures"] = json!([{"source": 0, "sampler": 0}]);
    }
    document["materials"] = json!([material]);
    document["bufferViews"] = Value::Array(binary.views);
    document["buffers"] = json!([{"byteLength": binary.bytes.len()}]);
    packed(&document, &binary.bytes)
}

/// Header, JSON chunk and binary chunk.
fn packed(document: &Value, binary: &[u8]) -> Result<Vec<u8>, IoError> {
    let failed = |reason: String| IoError::Encode {
        name: "GLB mesh",
        reason,
    };
    let mut json = serde_json::to_vec(document).map_err(|error| failed(error.to_string()))?;
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = u32::try_from(12 + 8 + json.len() + 8 + binary.len())
        .map_err(|_| failed("more than 4 GiB".to_owned()))?;
    let mut bytes = Vec::with_capacity(length as usize);
    bytes.extend(b"glTF");
    bytes.extend(2u32.to_le_bytes());
    bytes.extend(length.to_le_bytes());
    for (kind, content) in [(b"JSON", &json[..]), (b"BIN\0", binary)] {
        bytes.extend((content.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(content);
    }
    Ok(bytes)
}
