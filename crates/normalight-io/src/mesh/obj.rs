use super::{Soup, check_counts, wrong_format, wrong_mesh};
use crate::IoError;
use normalight_core::{CoreError, Vec3};
use std::io::{BufRead, Read, Result as IoResult};
use tobj::{LoadError, LoadOptions, load_obj_buf};

const FORMAT: &str = "OBJ";

/// One mesh of all objects and groups, polygons as fans; vertices are numbered as faces use them.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Soup, IoError> {
    let (vertices, triangles) = count(bytes);
    check_counts(name, FORMAT, vertices, triangles)?;
    let options = LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..LoadOptions::default()
    };
    let mut lines = GeometryReader::new(bytes);
    let loaded = load_obj_buf(&mut lines, &options, |_| Err(LoadError::GenericFailure));
    let (models, _) = loaded.map_err(|error| match error {
        LoadError::FaceVertexOutOfBounds => strange_corner(name, bytes, vertices),
        error => {
            let line = quoted(lines.number, lines.line);
            wrong_format(
                name,
                FORMAT,
                format!("{line}: {error}"),
                "v x y z or f a b c",
            )
        }
    })?;
    // Without the lines that start objects there is one model.
    let Some(mesh) = models.into_iter().next().map(|model| model.mesh) else {
        return Err(wrong_mesh(name, CoreError::NoTriangles));
    };
    if mesh.positions.iter().any(|value| !value.is_finite())
        && let Some((number, line)) = geometry_lines(bytes).find(|(_, line)| is_infinite(line))
    {
        return Err(wrong_format(
            name,
            FORMAT,
            quoted(number, line),
            "finite numbers",
        ));
    }
    let positions = mesh.positions.as_chunks::<3>().0;
    Ok(Soup {
        positions: positions.iter().copied().map(Vec3::from).collect(),
        triangles: mesh.indices.as_chunks::<3>().0.to_vec(),
    })
}

/// Vertices, and an upper bound of the triangles: faces of one or two corners count too, because
/// the decoder keeps them for a while.
fn count(bytes: &[u8]) -> (usize, usize) {
    geometry_lines(bytes).fold((0, 0), |(vertices, triangles), (_, line)| {
        if line[0] == b'v' {
            return (vertices + 1, triangles);
        }
        let corners = line[1..].split(u8::is_ascii_whitespace);
        let corners = corners.filter(|corner| !corner.is_empty()).count();
        (vertices, triangles + corners.saturating_sub(2).max(1))
    })
}

/// The lines of vertices and faces with their numbers, without comments and colours: all that is
/// shown to the decoder, so that textures, materials and names cannot be wrong.
fn geometry_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let lines = bytes.split(|&byte| byte == b'\n').enumerate();
    lines.filter_map(|(index, line)| {
        let line = line.split(|&byte| byte == b'#').next()?.trim_ascii();
        let (key, rest) = line.split_first()?;
        if !matches!(key, b'v' | b'f') || !rest.first()?.is_ascii_whitespace() {
            return None;
        }
        let kept = if *key == b'v' {
            without_colour(line)
        } else {
            line
        };
        Some((index + 1, kept))
    })
}

/// `v x y z` of a line that goes on with a colour or more; a fourth number alone is a weight.
fn without_colour(line: &[u8]) -> &[u8] {
    let starts = |index: usize| {
        let before = index.checked_sub(1).and_then(|before| line.get(before));
        before.is_some_and(u8::is_ascii_whitespace) && !line[index].is_ascii_whitespace()
    };
    let mut words = (1..line.len()).filter(|&index| starts(index)).skip(3);
    match (words.next(), words.next()) {
        (Some(fourth), Some(_)) => &line[..fourth],
        _ => line,
    }
}

fn is_infinite(line: &[u8]) -> bool {
    let words = str::from_utf8(line).unwrap_or_default().split_whitespace();
    line[0] == b'v'
        && words
            .skip(1)
            .any(|word| word.parse().is_ok_and(|value: f32| !value.is_finite()))
}

/// The error for a corner that names no vertex; negative ones count back from their line.
fn strange_corner(name: &str, bytes: &[u8], vertices: usize) -> IoError {
    let mut seen = 0;
    let strange = geometry_lines(bytes).find(|(_, line)| {
        if line[0] == b'v' {
            seen += 1;
            return false;
        }
        let words = str::from_utf8(line).unwrap_or_default().split_whitespace();
        let corners = words.skip(1).filter_map(|word| word.split('/').next());
        corners
            .filter_map(|word| word.parse().ok())
            .any(|index: i64| match index {
                0 => true,
                1.. => index.unsigned_abs() > vertices as u64,
                _ => index.unsigned_abs() > seen,
            })
    });
    let (number, line) = strange.unwrap_or_default();
    wrong_format(
        name,
        FORMAT,
        quoted(number, line),
        format!("corners among {vertices} vertices"),
    )
}

fn quoted(number: usize, line: &[u8]) -> String {
    let line: String = String::from_utf8_lossy(line).chars().take(80).collect();
    format!("line {number} {line:?}")
}

/// Hands out [`geometry_lines`] and remembers the last one, for messages.
struct GeometryReader<'a, I> {
    lines: I,
    number: usize,
    line: &'a [u8],
    /// What is left of the line, and then of the line's end.
    rest: &'a [u8],
    ended: bool,
}

impl<'a> GeometryReader<'a, std::iter::Empty<(usize, &'a [u8])>> {
    fn new(bytes: &'a [u8]) -> GeometryReader<'a, impl Iterator<Item = (usize, &'a [u8])>> {
        GeometryReader {
            lines: geometry_lines(bytes),
            number: 0,
            line: &[],
            rest: &[],
            ended: true,
        }
    }
}

impl<'a, I: Iterator<Item = (usize, &'a [u8])>> BufRead for GeometryReader<'a, I> {
    fn fill_buf(&mut self) -> IoResult<&[u8]> {
        if self.rest.is_empty() && !self.ended {
            self.rest = b"\n";
            self.ended = true;
        } else if self.rest.is_empty()
            && let Some((number, line)) = self.lines.next()
        {
            (self.number, self.line, self.rest) = (number, line, line);
            self.ended = false;
        }
        Ok(self.rest)
    }

    fn consume(&mut self, amount: usize) {
        self.rest = &self.rest[amount..];
    }
}

impl<'a, I: Iterator<Item = (usize, &'a [u8])>> Read for GeometryReader<'a, I> {
    fn read(&mut self, out: &mut [u8]) -> IoResult<usize> {
        let count = self.fill_buf()?.read(out)?;
        self.consume(count);
        Ok(count)
    }
}
