//! A small object to write and read as part of a set.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
use normalight_core::{Light, Mask, NormalMap, Samples, StackImage, Transfer, Vec3};
use normalight_io::{ObjectToPublish, PublishedEntry, decode_image};
use std::path::{Path, PathBuf};

/// Images, maps and lights of half a ball.
pub struct Object {
    pub images: Vec<StackImage>,
    pub normals: NormalMap,
    pub mask: Mask,
    pub depth: Vec<f32>,
    pub lights: Vec<Light>,
}

pub fn entry(shape: &str, material: &str) -> PublishedEntry {
    PublishedEntry::new(shape, material).unwrap()
}

pub fn half_ball(side: usize) -> Object {
    let centre = (side as f32 - 1.0) / 2.0;
    let radius = side as f32 * 0.45;
    let normal = |pixel: usize| {
        let x = ((pixel % side) as f32 - centre) / radius;
        let y = (centre - (pixel / side) as f32) / radius;
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        if z > 0.0 {
            Vec3::new(x, y, z)
        } else {
            Vec3::ZERO
        }
    };
    let normals: Vec<Vec3> = (0..side * side).map(normal).collect();
    let lights: Vec<Light> = [
        (Vec3::new(0.3, 0.2, 1.0), [1.0; 3]),
        (Vec3::new(-0.5, 0.1, 1.0), [0.7, 1.1, 0.333]),
        (Vec3::new(0.0, -0.7, 1.0), [0.2, 0.9, 1e-5]),
        (Vec3::Z, [1.0; 3]),
    ]
    .map(|(direction, intensity)| Light {
        intensity,
        ..Light::new(direction, 1.0)
    })
    .to_vec();
    let image = |(index, light): (usize, &Light)| {
        let shades = normals
            .iter()
            .map(|normal| normal.dot(light.direction).max(0.0) * 0.9);
        let (channels, samples) = match index % 2 {
            0 => {
                let codes =
                    shades.flat_map(|shade| [0.2, 0.6, 1.0].map(|k| (k * shade * 65_535.0) as u16));
                (3, Samples::U16(codes.collect()))
            }
            _ => (
                1,
                Samples::U8(shades.map(|shade| (shade * 255.0) as u8).collect()),
            ),
        };
        StackImage {
            name: format!("light_{index:02}.png"),
            width: side,
            height: side,
            channels,
            samples,
            transfer: Transfer::Linear,
        }
    };
    Object {
        images: lights.iter().enumerate().map(image).collect(),
        mask: Mask::new(
            side,
            side,
            normals.iter().map(|&n| n != Vec3::ZERO).collect(),
        ),
        depth: normals.iter().map(|normal| normal.z * radius).collect(),
        normals: NormalMap::new(side, side, normals),
        lights,
    }
}

impl Object {
    pub fn as_entry<'a>(&'a self, entry: &'a PublishedEntry) -> ObjectToPublish<'a> {
        ObjectToPublish {
            entry,
            images: &self.images,
            normals: &self.normals,
            mask: &self.mask,
            depth: Some(&self.depth),
            lights: &self.lights,
        }
    }
}

/// All files and folders below a folder, sorted, with slashes.
pub fn tree(root: &Path) -> Vec<String> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, found);
            }
            found.push(path);
        }
    }
    let mut found = Vec::new();
    walk(root, &mut found);
    let relative = found.iter().map(|path| path.strip_prefix(root).unwrap());
    let mut names: Vec<String> = relative
        .map(|path| path.display().to_string().replace('\\', "/"))
        .collect();
    names.sort();
    names
}

/// A picture of normals as in the published sets.
pub fn codes(path: &Path) -> Samples {
    let bytes = std::fs::read(path).unwrap();
    decode_image("n.png", &bytes, Default::default())
        .unwrap()
        .image
        .samples
}
