//! Masks as programs write them.
mod labels;
mod scale;

use crate::color::mapped;
use crate::decode::{Stored, decode_stored, turned_mask};
use crate::{ColorMode, IoError, Notice};
use normalight_core::{ImageStack, Mask, luminance};

/// Share of half-bright pixels above which an image is rather a picture than a mask with soft edges.
const SOFT: f32 = 0.1;
/// Where a value counts as half-bright, as parts of the way from the darkest to the brightest.
const HALF_BRIGHT: [f32; 2] = [0.2, 0.8];

/// A mask from a file, with what is doubtful about it.
pub(crate) struct MaskFile {
    pub(crate) mask: Mask,
    pub(crate) notices: Vec<Notice>,
}

/// Decodes an image as a mask, whatever values it is written in.
///
/// - Two clear values: inside is what is above the middle of the darkest and the brightest, also
///   with soft edges or the noise of JPEG; one value alone is all inside unless it is 0.
/// - Few clear values or colours (labels of parts, palettes): all but black, or but the most common
///   of the frame's border, are the object.
/// - Where all colours are the same or those of a picture, the transparency is the mask.
/// - A mask whose inside is the border of the frame and not its middle is inverted.
///
/// # Errors
/// As [`decode_image`](crate::decode_image).
pub fn decode_mask(name: &str, bytes: &[u8]) -> Result<Mask, IoError> {
    Ok(read(name, bytes)?.mask)
}

/// As [`decode_mask`], with what is doubtful.
pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<MaskFile, IoError> {
    let Stored {
        image,
        alpha,
        orientation,
        mut notices,
        ..
    } = decode_stored(name, bytes, ColorMode::Linear)?;
    let (width, height) = (image.width, image.height);
    let values = mapped(&image.samples, |value| value);
    let colours: Vec<[f32; 3]> = values
        .chunks_exact(image.channels)
        .map(|pixel| match *pixel {
            [r, g, b] => [r, g, b],
            _ => [pixel[0]; 3],
        })
        .collect();
    drop(values);
    let file = || name.to_owned();
    let mask = match alpha {
        Some(alpha) if is_picture_or_plain(&colours, &alpha) => {
            notices.push(Notice::MaskFromTransparency { file: file() });
            alpha
        }
        _ => match labels::object(&colours, width) {
            Some(labels::Object { inside, parts }) => {
                notices.push(Notice::MaskLabels {
                    file: file(),
                    parts,
                });
                Mask::new(width, height, inside)
            }
            None => {
                let (inside, doubt) = halved(name, &colours);
                notices.extend(doubt);
                Mask::new(width, height, inside)
            }
        },
    };
    let mask = match is_inverted(&mask) {
        true => {
            notices.push(Notice::MaskInverted { file: file() });
            let inside = mask.inside().iter().map(|inside| !inside).collect();
            Mask::new(width, height, inside)
        }
        false => mask,
    };
    if mask.count() == width * height {
        notices.push(Notice::MaskFull { file: file() });
    }
    Ok(MaskFile {
        mask: turned_mask(mask, orientation),
        notices,
    })
}

impl MaskFile {
    /// At the size of some photographs, where only the scale differs.
    pub(crate) fn fitted(mut self, name: &str, stack: &ImageStack) -> Self {
        let size = [stack.width(), stack.height()];
        let own = [self.mask.width(), self.mask.height()];
        if own != size
            && let Some(mask) = scale::scaled(&self.mask, size)
        {
            self.mask = mask;
            self.notices.push(Notice::MaskScaled {
                file: name.to_owned(),
                from: own,
                to: size,
            });
        }
        self
    }
}

fn range(values: impl Iterator<Item = f32>) -> (f32, f32) {
    values.fold((f32::MAX, f32::MIN), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

/// Share of values that are neither dark nor bright within their range.
fn half_bright(greys: &[f32], (low, high): (f32, f32)) -> f32 {
    let [from, to] = HALF_BRIGHT.map(|part| low + part * (high - low));
    let between = greys.iter().filter(|&&grey| grey > from && grey < to);
    between.count() as f32 / greys.len().max(1) as f32
}

/// Whether colours beside a transparency that varies say nothing about the object's shape: all the
/// same, or a picture of the object that is cut out.
fn is_picture_or_plain(colours: &[[f32; 3]], alpha: &Mask) -> bool {
    let all = range(colours.iter().copied().map(luminance));
    if all.1 - all.0 < 1e-6 {
        return true;
    }
    let pairs = colours.iter().zip(alpha.inside());
    let opaque = pairs.filter(|(_, inside)| **inside);
    let greys: Vec<f32> = opaque.map(|(&colour, _)| luminance(colour)).collect();
    let own = range(greys.iter().copied());
    alpha.count() > 0 && own.1 > own.0 && half_bright(&greys, own) > SOFT
}

/// What is above the middle of the values, and what is doubtful about that.
fn halved(name: &str, colours: &[[f32; 3]]) -> (Vec<bool>, Option<Notice>) {
    let greys: Vec<f32> = colours.iter().copied().map(luminance).collect();
    let (low, high) = range(greys.iter().copied());
    // One value alone: everything, whatever the value, unless it is 0.
    let above = match high - low < 1e-6 {
        true => 0.0,
        false => (low + high) / 2.0,
    };
    let inside = greys.iter().map(|&grey| grey > above).collect();
    let file = name.to_owned();
    let half = half_bright(&greys, (low, high));
    let doubt = match low < high {
        true if half > SOFT => Some(Notice::MaskSoft { file, share: half }),
        true if low > 0.02 || high < 0.98 => Some(Notice::MaskValues {
            file,
            values: vec![low, high],
            above,
        }),
        _ => None,
    };
    (inside, doubt)
}

/// Whether the border of the frame is inside and what is outside lies in the frame.
fn is_inverted(mask: &Mask) -> bool {
    let (width, height) = (mask.width(), mask.height());
    let (mut border, mut middle) = ([0usize; 2], [0usize; 2]);
    for (pixel, &inside) in mask.inside().iter().enumerate() {
        let (x, y) = (pixel % width, pixel / width);
        let edge = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
        let central = |place: usize, side: usize| 4 * place >= side && 4 * place < 3 * side;
        if edge {
            border[usize::from(inside)] += 1;
        } else if central(x, width) && central(y, height) {
            middle[usize::from(inside)] += 1;
        }
    }
    let share = |[outside, inside]: [usize; 2]| inside as f32 / (outside + inside).max(1) as f32;
    let (border, middle) = (share(border), share(middle));
    let outside = width * height - mask.count();
    // Objects that fill the frame have bright borders too, but little that is outside; inverted
    // ones may cross the border.
    (border >= 0.95 && 50 * outside >= width * height) || (border >= 0.6 && middle < 0.4)
}
