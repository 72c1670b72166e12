use super::ply_elements::{FACE_LISTS, Face, Skipped, Vertex};
use super::{Soup, check_counts, wrong_format, wrong_mesh};
use crate::IoError;
use normalight_core::{CoreError, MAX_TRIANGLES};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    DefaultElement, ElementDef, Encoding, Header, PropertyAccess, PropertyType, ScalarType,
};

const FORMAT: &str = "PLY";

/// Longest header, and longest line of an ascii file.
const MAX_LINE_BYTES: usize = 1 << 20;

const HEADER: &str = "a header with x, y, z of vertex and a list vertex_indices of face";

/// Reads element by element, so that no more is kept than becomes part of the mesh.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Soup, IoError> {
    let (header, mut rest) = read_header(name, bytes)?;
    let mut soup = Soup::default();
    for element in header.elements.values() {
        check_size(name, &header, element, rest.len())?;
        let source = Source {
            name,
            encoding: header.encoding,
            element,
        };
        match element.name.as_str() {
            "vertex" => {
                check_counts(name, FORMAT, element.count, 0)?;
                soup.positions.reserve_exact(element.count);
                source.each(&mut rest, |Vertex(position)| {
                    soup.positions.push(position);
                    Ok(())
                })?;
            }
            "face" => source.each(&mut rest, |face: Face| add_fan(name, &mut soup, &face.0))?,
            _ => source.each(&mut rest, |_: Skipped| Ok(()))?,
        }
    }
    Ok(soup)
}

fn read_header<'a>(name: &str, bytes: &'a [u8]) -> Result<(Header, &'a [u8]), IoError> {
    let head = &bytes[..bytes.len().min(MAX_LINE_BYTES)];
    let end = b"end_header";
    if !head.starts_with(b"ply") || !head.windows(end.len()).any(|window| window == end) {
        let found = "content that does not begin with ply .. end_header";
        return Err(wrong_format(name, FORMAT, found, HEADER));
    }
    let mut reader = Reader::new(bytes);
    let header = Parser::<DefaultElement>::new()
        .read_header(&mut reader)
        .map_err(|error| wrong_format(name, FORMAT, error.to_string(), HEADER))?;
    let has = |element: &str, properties: &[&str]| {
        let element = header.elements.get(element);
        element.is_some_and(|element| {
            properties
                .iter()
                .any(|&p| element.properties.contains_key(p))
        })
    };
    for (element, properties) in [
        ("vertex", &["x"][..]),
        ("vertex", &["y"]),
        ("vertex", &["z"]),
        ("face", &FACE_LISTS),
    ] {
        if !has(element, properties) {
            let found = format!("no property {} of {element}", properties[0]);
            return Err(wrong_format(name, FORMAT, found, HEADER));
        }
    }
    Ok((header, reader.into_inner()))
}

/// Fails when the rest of the file cannot hold all elements: a header may claim any number.
fn check_size(
    name: &str,
    header: &Header,
    element: &ElementDef,
    rest: usize,
) -> Result<(), IoError> {
    let properties = element.properties.values();
    let smallest: usize = match header.encoding {
        // A digit and what parts it from the next.
        Encoding::Ascii => 2 * element.properties.len(),
        _ => properties
            .map(|property| smallest_size(&property.data_type))
            .sum(),
    };
    // The last line of an ascii file may have no end.
    if element.count <= (rest + 1) / smallest.max(1) {
        return Ok(());
    }
    let ElementDef {
        name: kind, count, ..
    } = element;
    let found = format!("{count} elements {kind:?} in {rest} bytes");
    let expected = format!("at least {} bytes for each", smallest.max(1));
    Err(wrong_format(name, FORMAT, found, expected))
}

fn smallest_size(kind: &PropertyType) -> usize {
    match kind {
        PropertyType::Scalar(scalar) | PropertyType::List(scalar, _) => match scalar {
            ScalarType::Char | ScalarType::UChar => 1,
            ScalarType::Short | ScalarType::UShort => 2,
            ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
            ScalarType::Double => 8,
        },
    }
}

fn add_fan(name: &str, soup: &mut Soup, corners: &[u32]) -> Result<(), IoError> {
    let found = soup.triangles.len() + corners.len().saturating_sub(2);
    if found > MAX_TRIANGLES {
        return Err(wrong_mesh(
            name,
            CoreError::TooManyTriangles {
                found,
                allowed: MAX_TRIANGLES,
            },
        ));
    }
    if let [first, others @ ..] = corners {
        let edges = others.windows(2).map(|edge| [*first, edge[0], edge[1]]);
        soup.triangles.extend(edges);
    }
    Ok(())
}

/// All elements of one kind.
struct Source<'a> {
    name: &'a str,
    encoding: Encoding,
    element: &'a ElementDef,
}

impl Source<'_> {
    /// Decodes the elements and takes them off the beginning of `rest`.
    fn each<E: PropertyAccess>(
        &self,
        rest: &mut &[u8],
        mut take: impl FnMut(E) -> Result<(), IoError>,
    ) -> Result<(), IoError> {
        let parser = Parser::<E>::new();
        for index in 0..self.element.count {
            let decoded = match self.encoding {
                Encoding::Ascii => {
                    let line = self.next_line(rest, index)?;
                    parser.read_ascii_element(line, self.element)
                }
                Encoding::BinaryBigEndian => parser.read_big_endian_element(rest, self.element),
                Encoding::BinaryLittleEndian => {
                    parser.read_little_endian_element(rest, self.element)
                }
            };
            take(decoded.map_err(|error| self.wrong(index, &error.to_string()))?)?;
        }
        Ok(())
    }

    fn next_line<'b>(&self, rest: &mut &'b [u8], index: usize) -> Result<&'b str, IoError> {
        let reach = &rest[..rest.len().min(MAX_LINE_BYTES)];
        let length = match reach.iter().position(|&byte| byte == b'\n') {
            Some(end) => end + 1,
            None if reach.is_empty() => return Err(self.wrong(index, "the end of the file")),
            None if reach.len() < rest.len() => return Err(self.wrong(index, "a very long line")),
            None => reach.len(),
        };
        let (line, after) = rest.split_at(length);
        *rest = after;
        str::from_utf8(line).map_err(|_| self.wrong(index, "a line that is no text"))
    }

    fn wrong(&self, index: usize, found: &str) -> IoError {
        let ElementDef { name, count, .. } = self.element;
        let found = format!("at {name} {index}: {found}");
        wrong_format(
            self.name,
            FORMAT,
            found,
            format!("{count} elements {name:?} as the header says"),
        )
    }
}
