//! The list of an object's images with their lights.
use super::entry::is_plain;
use crate::IoError;
use crate::light_text::{check_direction, is_intensity, wrong_line};
use normalight_core::{Light, StackImage, Vec3};
use std::fmt::Write;

/// Lines `image x y z`, `image x y z intensity` or `image x y z r g b`.
pub(in crate::native) fn parse(name: &str, text: &str) -> Result<Vec<(String, Light)>, IoError> {
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let lines = lines.map(|(index, line)| (index + 1, line.trim()));
    lines
        .filter(|(_, line)| !line.is_empty())
        .map(|(number, line)| {
            parse_line(line).map_err(|expected| wrong_line(name, number, line, expected))
        })
        .collect()
}

fn parse_line(line: &str) -> Result<(String, Light), &'static str> {
    let mut words = line.split_whitespace();
    let image = words.next().filter(|image| is_plain(image));
    let image = image.ok_or("the plain name of an image, and its light")?;
    let numbers: Option<Vec<f32>> = words.map(|word| word.parse().ok()).collect();
    let (direction, intensity) = match numbers.as_deref() {
        Some(&[x, y, z]) => ([x, y, z], [1.0; 3]),
        Some(&[x, y, z, grey]) => ([x, y, z], [grey; 3]),
        Some(&[x, y, z, r, g, b]) => ([x, y, z], [r, g, b]),
        _ => return Err("image x y z, or image x y z r g b"),
    };
    let direction =
        check_direction(direction.into()).ok_or("a finite direction that is not zero")?;
    if !intensity.into_iter().all(is_intensity) {
        return Err("intensities above zero and below 1e30");
    }
    let light = Light {
        intensity,
        ..Light::new(direction, 1.0)
    };
    Ok((image.to_owned(), light))
}

/// Lines `image x y z r g b`, one space between, which [`parse`] and the loaders of the published
/// sets understand. Numbers are written so that they come back exactly.
pub(super) fn text(images: &[StackImage], lights: &[Light]) -> String {
    let mut text = String::new();
    for (image, light) in images.iter().zip(lights) {
        let Vec3 { x, y, z } = light.direction;
        let [r, g, b] = light.intensity;
        // Writing into a string cannot fail.
        let _ = writeln!(text, "{} {x} {y} {z} {r} {g} {b}", image.name);
    }
    text
}
