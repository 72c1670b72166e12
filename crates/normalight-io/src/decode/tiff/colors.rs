//! What the channels of a page mean.
use super::codes::Codes;
use super::directory::Directory;
use super::layout::{Kind, Layout};
use super::tags::{self, compression, photometric};
use crate::decode::source::Source;
use crate::{IoError, Notice};
use normalight_core::Samples;

const EXPORT: &str = "export it as grey or RGB of 8 or 16 bits";

/// The channels of a page.
pub(super) struct Meaning {
    photometric: u64,
    /// Channels that are colours: 1 or 3.
    colours: usize,
    /// Position of the channel that is transparency.
    alpha: Option<usize>,
    pub(super) premultiplied: bool,
}

impl Meaning {
    /// # Errors
    /// Colours that are not read, by their name.
    pub(super) fn new(source: &Source, page: &Directory, layout: &Layout) -> Result<Self, IoError> {
        let usual = match layout.samples {
            1 | 2 => photometric::BLACK_IS_ZERO,
            _ => photometric::RGB,
        };
        let kind = page.one(tags::PHOTOMETRIC).unwrap_or(usual);
        let colours = match kind {
            photometric::WHITE_IS_ZERO
            | photometric::BLACK_IS_ZERO
            | photometric::PALETTE
            | photometric::MASK => 1,
            photometric::RGB | photometric::YCBCR => 3,
            other => return Err(source.unread(photometric::name(other), EXPORT)),
        };
        let samples = layout.samples;
        if samples < colours {
            return Err(source.damaged(format!("{samples} channels cannot be its colours")));
        }
        let mut extra = page.all(tags::EXTRA_SAMPLES);
        // What is said of channels that are not there means nothing.
        extra.truncate(samples - colours);
        if colours == 1 && samples > 2 && extra.len() + 1 < samples {
            let found = format!("{samples} channels that are said to be grey");
            return Err(source.unread(found, EXPORT));
        }
        // 1: transparency that colours were multiplied by, 2: other transparency. Where nothing is
        // said, one more channel is nearly always transparency.
        let alpha = match extra.is_empty() && samples == colours + 1 {
            true => Some(colours),
            false => extra.iter().position(|kind| matches!(kind, 1 | 2)),
        };
        let meaning = Self {
            photometric: kind,
            colours,
            premultiplied: alpha.is_some_and(|at| extra.get(at) == Some(&1)),
            alpha: alpha.map(|at| if extra.is_empty() { at } else { colours + at }),
        };
        meaning.check_luma(source, page, layout)?;
        Ok(meaning)
    }

    /// Luma and chroma are read only where every pixel has all three.
    fn check_luma(
        &self,
        source: &Source,
        page: &Directory,
        layout: &Layout,
    ) -> Result<(), IoError> {
        if self.photometric != photometric::YCBCR {
            return Ok(());
        }
        if layout.bits != 8 || layout.kind != Kind::Unsigned {
            return Err(source.unread("YCbCr colours of more than 8 bits", EXPORT));
        }
        let shared = page.all(tags::SUBSAMPLING);
        // The default is 2 by 2; JPEG says it itself and its decoder fills up.
        if shared != [1, 1] && layout.compression != compression::JPEG {
            return Err(source.unread("YCbCr colours that pixels share, without JPEG", EXPORT));
        }
        Ok(())
    }

    /// Channels that are handed on: colours, then transparency.
    pub(super) fn channels(&self) -> usize {
        let colours = match self.photometric {
            photometric::PALETTE => 3,
            _ => self.colours,
        };
        colours + usize::from(self.alpha.is_some())
    }

    /// Channels that are left out.
    pub(super) fn notice(&self, source: &Source, layout: &Layout) -> Option<Notice> {
        let taken = self.colours + usize::from(self.alpha.is_some());
        (layout.samples > taken).then(|| Notice::ExtraChannels {
            file: source.name.to_owned(),
            channels: layout.samples - taken,
        })
    }

    /// Which channels are taken.
    pub(super) fn places(&self) -> Vec<usize> {
        (0..self.colours).chain(self.alpha).collect()
    }

    /// What those channels are as colours and transparency.
    ///
    /// # Errors
    /// A palette that lacks colours.
    pub(super) fn apply(
        &self,
        source: &Source,
        page: &Directory,
        codes: Codes,
    ) -> Result<Samples, IoError> {
        let count = self.places().len();
        match self.photometric {
            photometric::PALETTE => through_palette(source, page, codes, self.alpha.is_some()),
            photometric::WHITE_IS_ZERO => Ok(inverted(codes.scaled(), count)),
            photometric::YCBCR => Ok(rgb_of_luma(page, codes.scaled(), count)),
            _ => Ok(codes.scaled()),
        }
    }
}

/// Grey counted from white; an alpha beside it stays.
fn inverted(samples: Samples, channels: usize) -> Samples {
    fn each<T: Copy>(mut values: Vec<T>, channels: usize, invert: impl Fn(T) -> T) -> Vec<T> {
        let greys = values.iter_mut().step_by(channels);
        greys.for_each(|grey| *grey = invert(*grey));
        values
    }
    match samples {
        Samples::U8(codes) => Samples::U8(each(codes, channels, |code| 255 - code)),
        Samples::U16(codes) => Samples::U16(each(codes, channels, |code| 65_535 - code)),
        Samples::F32(values) => Samples::F32(each(values, channels, |value| 1.0 - value)),
    }
}

/// Luma and chroma as RGB (TIFF 6.0, section 21): coefficients are those of ITU-R BT.601 and the
/// range is full unless the page says otherwise.
fn rgb_of_luma(page: &Directory, samples: Samples, channels: usize) -> Samples {
    let Samples::U8(mut codes) = samples else {
        return samples;
    };
    let (red, green, blue) = match page.fractions(tags::LUMA)[..] {
        [red, green, blue] if green > 0.0 => (red, green, blue),
        _ => (0.299, 0.587, 0.114),
    };
    let range = match page.fractions(tags::REFERENCES)[..] {
        [a, b, c, d, e, f] if b > a && d > c && f > e => [a, b, c, d, e, f],
        _ => [0.0, 255.0, 128.0, 255.0, 128.0, 255.0],
    };
    let level =
        |code: u8, low: f32, high: f32, full: f32| (f32::from(code) - low) * full / (high - low);
    for pixel in codes.chunks_exact_mut(channels) {
        let luma = level(pixel[0], range[0], range[1], 255.0);
        let to_blue = level(pixel[1], range[2], range[3], 127.0);
        let to_red = level(pixel[2], range[4], range[5], 127.0);
        let r = luma + to_red * (2.0 - 2.0 * red);
        let b = luma + to_blue * (2.0 - 2.0 * blue);
        let g = (luma - red * r - blue * b) / green;
        for (code, value) in pixel.iter_mut().zip([r, g, b]) {
            *code = value.round().clamp(0.0, 255.0) as u8;
        }
    }
    Samples::U8(codes)
}

/// Colours of a palette; with transparency its channel follows.
fn through_palette(
    source: &Source,
    page: &Directory,
    codes: Codes,
    with_alpha: bool,
) -> Result<Samples, IoError> {
    let map = page.all(tags::COLOR_MAP);
    let entries = map.len() / 3;
    let full = codes.full as usize;
    if entries != full + 1 {
        return Err(source.damaged(format!(
            "its palette has {entries} colours instead of {}",
            full + 1
        )));
    }
    let stride = 1 + usize::from(with_alpha);
    let indices: Vec<u16> = match &codes.samples {
        Samples::U8(codes) => codes.iter().map(|&code| u16::from(code)).collect(),
        Samples::U16(codes) => codes.clone(),
        Samples::F32(_) => return Err(source.damaged("its palette has fractions for indices")),
    };
    // Palettes are written with 16 bits; most hold colours of 8, repeated or in the upper byte.
    let eight = map
        .iter()
        .all(|&code| code >> 8 == code & 255 || code & 255 == 0);
    let shift = if eight { 8 } else { 0 };
    let spread = (if eight { 255 } else { 65_535 }) / codes.full.max(1);
    let colors = indices.chunks_exact(stride).flat_map(|pixel| {
        let index = usize::from(pixel[0]);
        let color = [0, 1, 2].map(|channel| map[channel * entries + index] >> shift);
        let alpha = pixel
            .get(1)
            .map(|&alpha| u64::from(alpha) * u64::from(spread));
        color.into_iter().chain(alpha)
    });
    Ok(match eight {
        true => Samples::U8(colors.map(|code| code as u8).collect()),
        false => Samples::U16(colors.map(|code| code as u16).collect()),
    })
}
