use super::gltf_scene::{Document, Primitive};
use super::{Soup, check_counts, wrong_format};
use crate::IoError;
use crate::limits::MAX_TEXT_BYTES;
use glam::Mat4;

const FORMAT: &str = "GLB";

const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");

/// Reads the triangles of the default scene of a binary glTF file, nodes in place.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Soup, IoError> {
    let (json, binary) = chunks(bytes).ok_or_else(|| {
        let found = "no header, or less than it says";
        wrong_format(name, FORMAT, found, "a complete binary glTF 2 file")
    })?;
    if json.len() as u64 > MAX_TEXT_BYTES {
        let found = format!("{} bytes of JSON", json.len());
        return Err(wrong_format(
            name,
            FORMAT,
            found,
            format!("at most {MAX_TEXT_BYTES}"),
        ));
    }
    let document: Document = serde_json::from_slice(json)
        .map_err(|error| wrong_format(name, FORMAT, error.to_string(), "a glTF document"))?;
    let needed = &document.extensions_required;
    let packed = |extension: &&String| {
        ["draco", "meshopt", "quantization"]
            .iter()
            .any(|kind| extension.contains(kind))
    };
    let file = File {
        name,
        document: &document,
        binary,
    };
    match needed.iter().find(packed) {
        Some(extension) => Err(file.wrong(extension.as_str(), "geometry that is not compressed")),
        None => file.scene(),
    }
}

/// The JSON and the binary chunk.
fn chunks(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let mut rest = bytes.strip_prefix(b"glTF")?;
    let version = take_u32(&mut rest)?;
    let length = take_u32(&mut rest)? as usize;
    if version != 2 || length > bytes.len() {
        return None;
    }
    // Whatever follows the declared length is no part of the file.
    let mut rest = bytes.get(12..length)?;
    let (kind, json) = take_chunk(&mut rest)?;
    if kind != JSON {
        return None;
    }
    while !rest.is_empty() {
        let (kind, content) = take_chunk(&mut rest)?;
        if kind == BIN {
            return Some((json, content));
        }
    }
    Some((json, &[]))
}

fn take_u32(rest: &mut &[u8]) -> Option<u32> {
    let (value, after) = rest.split_first_chunk()?;
    *rest = after;
    Some(u32::from_le_bytes(*value))
}

fn take_chunk<'a>(rest: &mut &'a [u8]) -> Option<(u32, &'a [u8])> {
    let length = take_u32(rest)? as usize;
    let kind = take_u32(rest)?;
    let (content, after) = rest.split_at_checked(length)?;
    *rest = after;
    Some((kind, content))
}

/// A file with its document understood.
pub(super) struct File<'a> {
    pub(super) name: &'a str,
    pub(super) document: &'a Document,
    pub(super) binary: &'a [u8],
}

impl<'a> File<'a> {
    pub(super) fn wrong(&self, found: impl Into<String>, expected: &str) -> IoError {
        wrong_format(self.name, FORMAT, found, expected)
    }

    pub(super) fn item<T>(
        &self,
        list: &'a [T],
        kind: &str,
        index: usize,
    ) -> Result<&'a T, IoError> {
        list.get(index).ok_or_else(|| {
            let expected = format!("one of {} in the document", list.len());
            self.wrong(format!("{kind} {index}"), &expected)
        })
    }

    fn scene(&self) -> Result<Soup, IoError> {
        let roots = self.document.roots();
        let roots =
            roots.ok_or_else(|| self.wrong("a scene or child that is not there", "nodes"))?;
        let mut seen = vec![false; self.document.nodes.len()];
        let mut open: Vec<(usize, Mat4)> = Vec::new();
        open.extend(roots.iter().rev().map(|&root| (root, Mat4::IDENTITY)));
        let mut soup = Soup::default();
        while let Some((index, parent)) = open.pop() {
            let node = self.item(&self.document.nodes, "node", index)?;
            // Nodes that contain themselves would never end.
            if std::mem::replace(&mut seen[index], true) {
                return Err(self.wrong(format!("node {index} in two places"), "a tree of nodes"));
            }
            let transform = parent * node.transform();
            if let Some(mesh) = node.mesh {
                for primitive in &self.item(&self.document.meshes, "mesh", mesh)?.primitives {
                    self.add(primitive, transform, &mut soup)?;
                }
            }
            open.extend(node.children.iter().rev().map(|&child| (child, transform)));
        }
        Ok(soup)
    }

    fn add(&self, primitive: &Primitive, transform: Mat4, soup: &mut Soup) -> Result<(), IoError> {
        let cut = match primitive.mode.unwrap_or(4) {
            // Points and lines.
            0..=3 => return Ok(()),
            4 => list,
            5 => strip,
            6 => fan,
            mode => return Err(self.wrong(format!("primitives of mode {mode}"), "0 to 6")),
        };
        // Other kinds of geometry are told by extensions.
        let Some(position) = primitive.attributes.position else {
            return Ok(());
        };
        let position = self.item(&self.document.accessors, "accessor", position)?;
        let indices = primitive.indices;
        let indices = indices.map(|index| self.item(&self.document.accessors, "accessor", index));
        let indices = indices.transpose()?;
        let corners = indices.map_or(position.count, |indices| indices.count);
        let first = soup.positions.len();
        let triangles = match primitive.mode.unwrap_or(4) {
            4 => corners / 3,
            _ => corners.saturating_sub(2),
        };
        check_counts(
            self.name,
            FORMAT,
            first.saturating_add(position.count),
            soup.triangles.len().saturating_add(triangles),
        )?;
        let corners: Vec<u32> = match indices {
            Some(indices) => self.indices(indices, position.count)?,
            None => (0..position.count as u32).collect(),
        };
        let positions = self.positions(position)?;
        soup.positions
            .extend(positions.map(|position| transform.transform_point3(position)));
        // A mirror turns the order of the corners round.
        let mirrored = transform.determinant() < 0.0;
        let triangles = cut(&corners).into_iter().map(|[a, b, c]| {
            let [b, c] = if mirrored { [c, b] } else { [b, c] };
            [a, b, c].map(|corner| first as u32 + corner)
        });
        soup.triangles.extend(triangles);
        Ok(())
    }
}

fn list(corners: &[u32]) -> Vec<[u32; 3]> {
    corners.as_chunks().0.to_vec()
}

/// Every second triangle of a strip goes round the other way.
fn strip(corners: &[u32]) -> Vec<[u32; 3]> {
    let windows = corners.windows(3).enumerate();
    let turned = |(index, window): (usize, &[u32])| match index % 2 {
        0 => [window[0], window[1], window[2]],
        _ => [window[1], window[0], window[2]],
    };
    windows.map(turned).collect()
}

fn fan(corners: &[u32]) -> Vec<[u32; 3]> {
    let Some((&first, others)) = corners.split_first() else {
        return Vec::new();
    };
    others
        .windows(2)
        .map(|edge| [first, edge[0], edge[1]])
        .collect()
}
