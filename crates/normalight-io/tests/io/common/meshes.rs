//! One cube, written by hand in every format.
use normalight_core::Vec3;

/// The corners, in the order in which the faces use them.
pub const CORNERS: [[f32; 3]; 8] = [
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [-1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, -1.0],
];

/// Counter-clockwise from outside.
pub const QUADS: [[u32; 4]; 6] = [
    [0, 1, 2, 3],
    [4, 5, 6, 7],
    [1, 7, 6, 2],
    [4, 0, 3, 5],
    [3, 2, 6, 5],
    [4, 7, 1, 0],
];

pub fn positions() -> Vec<Vec3> {
    CORNERS.map(Vec3::from).to_vec()
}

pub fn triangles() -> Vec<[u32; 3]> {
    QUADS
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect()
}

/// Two objects, a texture, a normal, a comment, a colour, Windows line ends and indices that count
/// back.
pub const CUBE_OBJ: &str = "# a cube\r\nmtllib none.mtl\r\n\
    v -1 -1 1\r\nv 1 -1 1 0.5 0.5 0.5\r\nv 1 1 1\r\nv -1 1 1 # corner\r\n\
    vt 0 0\r\nvn 0 0 1\r\n\
    o front\r\nusemtl gold\r\nf 1/1/1 2/1/1 3/1/1 4/1/1\r\n\
    v -1 -1 -1\r\nv -1 1 -1\r\nv 1 1 -1\r\nv 1 -1 -1 1.0\r\n\
    g back\r\nf -4 -3 -2 -1\r\n\
    o sides\r\nf 2//1 8//1 7//1 3//1\r\nf 5 1 4 6\r\nf 4 3 7 6\r\nf 5 8 2 1\r\n";

/// How the numbers of a PLY file are written.
#[derive(Debug, Clone, Copy)]
pub enum PlyKind {
    Ascii,
    Little,
    Big,
}

/// Doubles, another element between and further properties everywhere.
pub fn cube_ply(kind: PlyKind, number: &str, list: &str) -> Vec<u8> {
    let encoding = match kind {
        PlyKind::Ascii => "ascii",
        PlyKind::Little => "binary_little_endian",
        PlyKind::Big => "binary_big_endian",
    };
    let mut bytes = format!(
        "ply\nformat {encoding} 1.0\ncomment by hand\nelement vertex 8\n\
         property {number} x\nproperty {number} y\nproperty {number} z\nproperty uchar red\n\
         element note 1\nproperty list uchar short words\nelement face 6\n\
         property uchar flag\nproperty list uchar int {list}\nend_header\n"
    )
    .into_bytes();
    if let PlyKind::Ascii = kind {
        for [x, y, z] in CORNERS {
            bytes.extend(format!("{x:.1} {y:.1e} {z} 7\n").bytes());
        }
        bytes.extend(b"2 5 -6\n");
        for [a, b, c, d] in QUADS {
            bytes.extend(format!("1 4 {a} {b} {c} {d}\n").bytes());
        }
        return bytes;
    }
    let mut put = |little: &[u8]| match kind {
        PlyKind::Big => bytes.extend(little.iter().rev()),
        _ => bytes.extend(little),
    };
    for corner in CORNERS {
        for value in corner {
            match number {
                "double" => put(&f64::from(value).to_le_bytes()),
                _ => put(&value.to_le_bytes()),
            }
        }
        put(&[7]);
    }
    put(&[2]);
    put(&5i16.to_le_bytes());
    put(&(-6i16).to_le_bytes());
    for quad in QUADS {
        put(&[1]);
        put(&[4]);
        for corner in quad {
            put(&corner.to_le_bytes());
        }
    }
    bytes
}

/// A GLB file of a document and a binary chunk.
pub fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF".to_vec();
    bytes.extend(2u32.to_le_bytes());
    bytes.extend((12 + 8 + json.len() as u32 + 8 + binary.len() as u32).to_le_bytes());
    for (kind, content) in [(b"JSON", &json[..]), (b"BIN\0", binary)] {
        bytes.extend((content.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(content);
    }
    bytes
}

/// Positions, then the triangles' corners in two bytes each.
pub fn cube_binary() -> Vec<u8> {
    let mut binary: Vec<u8> = CORNERS
        .iter()
        .flatten()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    let corners = triangles().into_iter().flatten();
    binary.extend(corners.flat_map(|corner| (corner as u16).to_le_bytes()));
    binary
}

/// The document of the cube; `nodes` must place mesh 0.
pub fn cube_json(nodes: &str) -> String {
    let head = r#""asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}]"#;
    let meshes =
        r#""meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0},"indices":1}]}]"#;
    let accessors = r#""accessors":[
        {"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},
        {"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}]"#;
    let views = r#""bufferViews":[{"buffer":0,"byteLength":96},
        {"buffer":0,"byteOffset":96,"byteLength":72}],"buffers":[{"byteLength":168}]"#;
    format!(r#"{{{head},"nodes":{nodes},{meshes},{accessors},{views}}}"#)
}

pub fn cube_glb() -> Vec<u8> {
    glb(&cube_json(r#"[{"mesh":0}]"#), &cube_binary())
}
