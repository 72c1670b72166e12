//! Numbers in the binary chunk of a glTF file.
use super::glb::File;
use super::gltf_scene::Accessor;
use crate::IoError;
use glam::Vec3;

// Types of numbers.
const BYTE: u32 = 5121;
const SHORT: u32 = 5123;
const INT: u32 = 5125;
const FLOAT: u32 = 5126;

impl<'a> File<'a> {
    /// Three numbers for each vertex.
    pub(super) fn positions(
        &self,
        accessor: &Accessor,
    ) -> Result<impl Iterator<Item = Vec3> + use<'a>, IoError> {
        if accessor.component_type != FLOAT || accessor.kind != "VEC3" {
            let Accessor {
                component_type,
                kind,
                ..
            } = accessor;
            let found = format!("positions of {kind} of type {component_type}");
            return Err(self.wrong(found, "VEC3 of type 5126 (float)"));
        }
        let items = self.items(accessor, 12)?;
        Ok(items.map(|item| {
            let number =
                |at: usize| f32::from_le_bytes(std::array::from_fn(|byte| item[at + byte]));
            Vec3::new(number(0), number(4), number(8))
        }))
    }

    /// Corners, all of them below `vertices`.
    pub(super) fn indices(
        &self,
        accessor: &Accessor,
        vertices: usize,
    ) -> Result<Vec<u32>, IoError> {
        let size = match accessor.component_type {
            BYTE => 1,
            SHORT => 2,
            INT => 4,
            other => {
                let expected = "5121, 5123 or 5125 (unsigned integers)";
                return Err(self.wrong(format!("indices of type {other}"), expected));
            }
        };
        if accessor.kind != "SCALAR" {
            return Err(self.wrong(format!("indices of {:?}", accessor.kind), "SCALAR"));
        }
        let number = |item: &[u8]| {
            item.iter()
                .rev()
                .fold(0, |sum, &byte| sum << 8 | u32::from(byte))
        };
        let indices: Vec<u32> = self.items(accessor, size)?.map(number).collect();
        match indices.iter().find(|&&index| index as usize >= vertices) {
            Some(index) => {
                let expected = format!("indices below {vertices}");
                Err(self.wrong(format!("a triangle with vertex {index}"), &expected))
            }
            None => Ok(indices),
        }
    }

    /// The items of an accessor, `size` bytes each.
    fn items(
        &self,
        accessor: &Accessor,
        size: usize,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, IoError> {
        let view = match accessor.buffer_view {
            Some(view) if accessor.sparse.is_none() => view,
            _ => return Err(self.wrong("a sparse or compressed accessor", "plain numbers")),
        };
        let view = self.item(&self.document.buffer_views, "bufferView", view)?;
        let buffer = self.item(&self.document.buffers, "buffer", view.buffer)?;
        if let Some(uri) = &buffer.uri {
            return Err(IoError::ExternalBuffer {
                name: self.name.to_owned(),
                uri: uri.chars().take(80).collect(),
            });
        }
        // Only the first buffer is the binary chunk.
        let binary = if view.buffer == 0 { self.binary } else { &[] };
        let stride = view.byte_stride.unwrap_or(size);
        let content = binary
            .get(view.byte_offset..)
            .and_then(|rest| rest.get(..view.byte_length));
        let content = content.and_then(|content| content.get(accessor.byte_offset..));
        let last = accessor
            .count
            .checked_sub(1)
            .and_then(|last| last.checked_mul(stride));
        let fits = |content: &&[u8]| match last {
            Some(last) => last
                .checked_add(size)
                .is_some_and(|end| end <= content.len()),
            None => accessor.count == 0,
        };
        match content.filter(fits) {
            Some(content) if stride >= size => {
                let items = content.chunks(stride).take(accessor.count);
                Ok(items.map(move |item| &item[..size]))
            }
            _ => {
                let Accessor { count, .. } = accessor;
                let found = format!("{count} items of {size} bytes beyond their buffer");
                Err(self.wrong(found, "items within the binary chunk"))
            }
        }
    }
}
