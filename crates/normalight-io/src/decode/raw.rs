//! Samples as decoded, and how they are parted into colours and transparency.
use crate::Notice;
use crate::color::Statement;
use image::metadata::Orientation;
use normalight_core::Samples;

/// Samples with all channels, and what the file says about them.
pub(super) struct Raw {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Grey, grey and alpha, RGB, or RGB and alpha.
    pub(super) channels: usize,
    /// `[height, width, channels]`
    pub(super) samples: Samples,
    /// Whether colours were multiplied by alpha.
    pub(super) premultiplied: bool,
    pub(super) statement: Statement,
    pub(super) orientation: Orientation,
    pub(super) notices: Vec<Notice>,
}

/// Colours apart from transparency.
pub(super) struct Parted {
    /// `[height, width, channels]`
    pub(super) samples: Samples,
    /// 1 or 3.
    pub(super) channels: usize,
    /// Pixels whose alpha is above half; `None` when all of it is opaque.
    pub(super) inside: Option<Vec<bool>>,
}

/// Parts interleaved samples.
pub(super) fn parted(samples: Samples, channels: usize, premultiplied: bool) -> Parted {
    if channels % 2 == 1 {
        return Parted {
            samples,
            channels,
            inside: None,
        };
    }
    let (samples, inside) = match samples {
        Samples::U8(all) => {
            let (kept, inside) = split(&all, channels, premultiplied);
            (Samples::U8(kept), inside)
        }
        Samples::U16(all) => {
            let (kept, inside) = split(&all, channels, premultiplied);
            (Samples::U16(kept), inside)
        }
        Samples::F32(all) => {
            let (kept, inside) = split(&all, channels, premultiplied);
            (Samples::F32(kept), inside)
        }
    };
    Parted {
        samples,
        channels: channels - 1,
        inside,
    }
}

fn split<T: Sample>(
    all: &[T],
    channels: usize,
    premultiplied: bool,
) -> (Vec<T>, Option<Vec<bool>>) {
    let colours = channels - 1;
    let alphas = all.iter().skip(colours).step_by(channels);
    let alphas = alphas.map(|alpha| alpha.value() / T::FULL);
    let mut kept = Vec::with_capacity(all.len() / channels * colours);
    for pixel in all.chunks_exact(channels) {
        kept.extend_from_slice(&pixel[..colours]);
    }
    if !alphas.clone().any(|alpha| alpha < 1.0) {
        return (kept, None);
    }
    if premultiplied {
        for (pixel, alpha) in kept.chunks_exact_mut(colours).zip(alphas.clone()) {
            if alpha > 0.0 && alpha < 1.0 {
                pixel
                    .iter_mut()
                    .for_each(|colour| *colour = T::nearest(colour.value() / alpha));
            }
        }
    }
    (kept, Some(alphas.map(|alpha| alpha > 0.5).collect()))
}

/// A type of sample that counts as a number.
trait Sample: Copy {
    /// What stands for 1.
    const FULL: f32;
    fn value(self) -> f32;
    /// The nearest sample; codes end at full scale.
    fn nearest(value: f32) -> Self;
}

impl Sample for u8 {
    const FULL: f32 = 255.0;
    fn value(self) -> f32 {
        f32::from(self)
    }
    fn nearest(value: f32) -> Self {
        value.round() as u8
    }
}

impl Sample for u16 {
    const FULL: f32 = 65_535.0;
    fn value(self) -> f32 {
        f32::from(self)
    }
    fn nearest(value: f32) -> Self {
        value.round() as u16
    }
}

impl Sample for f32 {
    const FULL: f32 = 1.0;
    fn value(self) -> f32 {
        self
    }
    fn nearest(value: f32) -> Self {
        value
    }
}
