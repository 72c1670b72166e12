use crate::{BenchmarkObject, EvaluateError};
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageFormat};
use normalight_core::{CoreError, ImageStack, Mask, Rect, Samples, StackImage, Transfer};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// What goes wrong with photographs and masks in practice, done to those of a benchmark.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Disturbance {
    /// Stored as JPEG of this quality, 1..=100.
    Jpeg(u8),
    /// Room light: to every photograph this share of the mean of all is added.
    Ambient(f32),
    /// Overexposed, so that this share of the object's samples is clipped at full scale.
    Clipped(f32),
    /// Encoded for viewing (sRGB) and taken as linear.
    Encoded,
    /// The mask reaches so many pixels beyond the object.
    Grown(u8),
    /// The mask stops so many pixels before the object's edge.
    Shrunk(u8),
}

impl Disturbance {
    /// How it is written, for messages.
    pub const EXPECTED: &str =
        "jpeg:1-100, ambient:SHARE, clipped:SHARE, encoded, grown:PIXELS or shrunk:PIXELS";

    /// What it is, for people.
    pub fn words(self) -> String {
        match self {
            Self::Jpeg(quality) => format!("JPEG of quality {quality}"),
            Self::Ambient(share) => format!("room light of {} of the lamp's", percent(share)),
            Self::Clipped(share) => format!("{} of the samples clipped", percent(share)),
            Self::Encoded => "encoded for viewing, taken as linear".to_owned(),
            Self::Grown(pixels) => format!("mask {pixels} pixels too large"),
            Self::Shrunk(pixels) => format!("mask {pixels} pixels too small"),
        }
    }

    /// Does it to an object.
    ///
    /// # Errors
    /// [`EvaluateError::Core`] when nothing is left of the mask; [`EvaluateError::Disturbance`] when a picture cannot be
    /// stored as JPEG.
    pub fn apply(self, object: &BenchmarkObject) -> Result<BenchmarkObject, EvaluateError> {
        let mut disturbed = object.clone();
        match self {
            Self::Grown(pixels) => disturbed.mask = moved(&object.mask, pixels, true),
            Self::Shrunk(pixels) => disturbed.mask = moved(&object.mask, pixels, false),
            Self::Jpeg(quality) => {
                let mut planes = linear(object);
                for plane in &mut planes {
                    *plane = by_jpeg(plane, object, quality)?;
                }
                disturbed.stack = stack(object, planes)?;
            }
            Self::Ambient(share) => {
                let mut planes = linear(object);
                let mean: Vec<f32> = (0..planes[0].len())
                    .map(|at| {
                        planes.iter().map(|plane| plane[at]).sum::<f32>() / planes.len() as f32
                    })
                    .collect();
                for plane in &mut planes {
                    plane
                        .iter_mut()
                        .zip(&mean)
                        .for_each(|(value, mean)| *value += share * mean);
                }
                disturbed.stack = stack(object, planes)?;
            }
            Self::Clipped(share) => {
                let mut planes = linear(object);
                let full = level(&planes, &object.mask, share);
                let clip = |value: &mut f32| *value = (*value / full).min(1.0);
                planes.iter_mut().flatten().for_each(clip);
                disturbed.stack = stack(object, planes)?;
            }
            Self::Encoded => {
                let mut planes = linear(object);
                let full = level(&planes, &object.mask, 0.0);
                let encode = |value: &mut f32| {
                    *value = Transfer::Srgb.encode((*value / full).clamp(0.0, 1.0))
                };
                planes.iter_mut().flatten().for_each(encode);
                disturbed.stack = stack(object, planes)?;
            }
        }
        if disturbed.mask.count() == 0 {
            let name = object.name.clone();
            return Err(CoreError::EmptyMask { name }.into());
        }
        Ok(disturbed)
    }
}

fn percent(share: f32) -> String {
    format!("{} %", f64::from((share * 1000.0).round()) / 10.0)
}

/// Linear RGB of every photograph.
///
/// # Shapes
/// For each `[3, height, width]`.
fn linear(object: &BenchmarkObject) -> Vec<Vec<f32>> {
    let whole = Rect::whole(object.stack.width(), object.stack.height());
    (0..object.stack.len())
        .map(|image| {
            let mut planes = vec![0.0; 3 * whole.area()];
            object.stack.linear_tile(image, whole, &mut planes);
            planes
        })
        .collect()
}

/// Planes as photographs again.
fn stack(object: &BenchmarkObject, planes: Vec<Vec<f32>>) -> Result<ImageStack, EvaluateError> {
    let area = object.stack.width() * object.stack.height();
    let images = object.stack.images().iter().zip(planes);
    let images = images.map(|(image, planes)| StackImage {
        name: image.name.clone(),
        width: image.width,
        height: image.height,
        channels: 3,
        samples: Samples::F32(
            (0..3 * area)
                .map(|at| planes[at % 3 * area + at / 3])
                .collect(),
        ),
        transfer: Transfer::Linear,
    });
    Ok(ImageStack::new(images.collect())?)
}

/// The value that this share of the object's samples exceeds.
fn level(planes: &[Vec<f32>], mask: &Mask, share: f32) -> f32 {
    let area = mask.inside().len();
    let pixels = mask.pixels();
    let mut values: Vec<f32> = planes
        .iter()
        .flat_map(|planes| {
            pixels
                .iter()
                .flat_map(move |&pixel| (0..3).map(move |c| planes[c * area + pixel]))
        })
        .collect();
    if values.is_empty() {
        return 1.0;
    }
    let rank = ((1.0 - share.clamp(0.0, 1.0)) * (values.len() - 1) as f32) as usize;
    let (_, level, _) = values.select_nth_unstable_by(rank, f32::total_cmp);
    level.max(f32::MIN_POSITIVE)
}

/// A photograph as it comes back from a JPEG whose full scale is the brightest sample.
fn by_jpeg(
    planes: &[f32],
    object: &BenchmarkObject,
    quality: u8,
) -> Result<Vec<f32>, EvaluateError> {
    let failed = |reason: String| EvaluateError::Disturbance(reason);
    let (width, height) = (object.stack.width(), object.stack.height());
    let area = width * height;
    let full = planes.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
    let code =
        |value: f32| (Transfer::Srgb.encode((value / full).clamp(0.0, 1.0)) * 255.0).round() as u8;
    let pixels: Vec<u8> = (0..3 * area)
        .map(|at| code(planes[at % 3 * area + at / 3]))
        .collect();
    let side = |side: usize| u32::try_from(side).map_err(|error| failed(error.to_string()));
    let mut file = Vec::new();
    JpegEncoder::new_with_quality(&mut file, quality)
        .encode(
            &pixels,
            side(width)?,
            side(height)?,
            ExtendedColorType::Rgb8,
        )
        .map_err(|error| failed(error.to_string()))?;
    let read = image::load_from_memory_with_format(&file, ImageFormat::Jpeg)
        .map_err(|error| failed(error.to_string()))?
        .to_rgb8();
    let value = |at: usize| {
        let code = read.as_raw()[at % area * 3 + at / area];
        Transfer::Srgb.decode(f32::from(code) / 255.0) * full
    };
    Ok((0..3 * area).map(value).collect())
}

/// A mask whose edge lies so many pixels further out, or in; a pixel moves to its eight neighbours at a time.
fn moved(mask: &Mask, pixels: u8, outwards: bool) -> Mask {
    let (width, height) = (mask.width(), mask.height());
    let mut inside = mask.inside().to_vec();
    for _ in 0..pixels {
        let before = inside.clone();
        let before = &before;
        for (at, value) in inside.iter_mut().enumerate() {
            let (x, y) = (at % width, at / width);
            let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
            let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
            let mut near = rows.flat_map(|y| columns.clone().map(move |x| before[y * width + x]));
            *value = if outwards {
                near.any(|inside| inside)
            } else {
                near.all(|inside| inside)
            };
        }
    }
    Mask::new(width, height, inside)
}

impl fmt::Display for Disturbance {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Jpeg(quality) => write!(formatter, "jpeg:{quality}"),
            Self::Ambient(share) => write!(formatter, "ambient:{share}"),
            Self::Clipped(share) => write!(formatter, "clipped:{share}"),
            Self::Encoded => write!(formatter, "encoded"),
            Self::Grown(pixels) => write!(formatter, "grown:{pixels}"),
            Self::Shrunk(pixels) => write!(formatter, "shrunk:{pixels}"),
        }
    }
}

impl From<Disturbance> for String {
    fn from(disturbance: Disturbance) -> Self {
        disturbance.to_string()
    }
}

impl TryFrom<String> for Disturbance {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl FromStr for Disturbance {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (kind, value) = text.split_once(':').unwrap_or((text, ""));
        let share = |most: f32| {
            let share: f32 = value.parse().ok()?;
            (share > 0.0 && share <= most).then_some(share)
        };
        let count = |most: u8| {
            value
                .parse()
                .ok()
                .filter(|count| (1..=most).contains(count))
        };
        let found = match kind {
            "jpeg" => count(100).map(Self::Jpeg),
            "ambient" => share(10.0).map(Self::Ambient),
            "clipped" => share(0.9).map(Self::Clipped),
            "encoded" if value.is_empty() => Some(Self::Encoded),
            "grown" => count(100).map(Self::Grown),
            "shrunk" => count(100).map(Self::Shrunk),
            _ => None,
        };
        found.ok_or_else(|| format!("expected {}", Self::EXPECTED))
    }
}
