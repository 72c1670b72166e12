use super::srgb::SrgbCodes;
use super::visible::Visible;

/// Side of a block.
const BLOCK: usize = 8;
const AREA: usize = BLOCK * BLOCK;

/// What baseline JPEG does to a picture: colours at half the resolution, and rounding of the blocks'
/// cosine coefficients (ITU-T T.81). The lossless half of the format, which changes nothing, is left out,
/// and so is the file.
#[derive(Debug, Clone)]
pub(crate) struct Jpeg {
    brightness: [f32; AREA],
    colour: [f32; AREA],
    /// `[frequency][place]`
    cosines: [[f32; BLOCK]; BLOCK],
}

/// Steps for brightness and colour at quality 50 (T.81, annex K).
const BRIGHTNESS: [u8; AREA] = [
    16, 11, 10, 16, 24, 40, 51, 61, 12, 12, 14, 19, 26, 58, 60, 55, 14, 13, 16, 24, 40, 57, 69, 56,
    14, 17, 22, 29, 51, 87, 80, 62, 18, 22, 37, 56, 68, 109, 103, 77, 24, 35, 55, 64, 81, 104, 113,
    92, 49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99,
];
const COLOUR: [u8; AREA] = [
    17, 18, 24, 47, 99, 99, 99, 99, 18, 21, 26, 66, 99, 99, 99, 99, 24, 26, 56, 99, 99, 99, 99, 99,
    47, 66, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99,
    99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99,
];

impl Jpeg {
    /// `quality` on the usual scale, 1..=100.
    pub(crate) fn new(quality: f32) -> Self {
        // The scale of the Independent JPEG Group, which all programs follow.
        let quality = quality.round().clamp(1.0, 100.0);
        let percent = if quality < 50.0 {
            (5000.0 / quality).floor()
        } else {
            200.0 - 2.0 * quality
        };
        let steps = |table: &[u8; AREA]| {
            table.map(|step| {
                ((f32::from(step) * percent + 50.0) / 100.0)
                    .floor()
                    .clamp(1.0, 255.0)
            })
        };
        Self {
            brightness: steps(&BRIGHTNESS),
            colour: steps(&COLOUR),
            cosines: std::array::from_fn(|frequency| {
                let scale: f32 = if frequency == 0 { 0.125 } else { 0.25 };
                std::array::from_fn(|place| {
                    let angle = (2 * place + 1) as f32 * frequency as f32;
                    scale.sqrt() * libm::cosf(angle * std::f32::consts::PI / 16.0)
                })
            }),
        }
    }

    /// Stores light as a JPEG file and decodes it again; black beside the object.
    pub(crate) fn store(&self, light: &mut [f32], visible: &Visible) {
        let codes = SrgbCodes::shared();
        let count = visible.pixels.len();
        // Whole blocks of colours, each pixel of which stands for four.
        let side = visible.size.next_multiple_of(2 * BLOCK);
        let mut planes = [(); 3].map(|()| vec![0.0f32; side * side]);
        for (index, &pixel) in visible.pixels.iter().enumerate() {
            let place = pixel as usize / visible.size * side + pixel as usize % visible.size;
            let value = |channel: usize| f32::from(codes.nearest(light[channel * count + index]));
            let [red, green, blue] = [value(0), value(1), value(2)];
            planes[0][place] = 0.299 * red + 0.587 * green + 0.114 * blue;
            planes[1][place] = -0.168_736 * red - 0.331_264 * green + 0.5 * blue;
            planes[2][place] = 0.5 * red - 0.418_688 * green - 0.081_312 * blue;
        }
        let [brightness, blueness, redness] = planes;
        let brightness = self.coded(brightness, side, &self.brightness, 128.0);
        let half = side / 2;
        let blueness = self.coded(halved(&blueness, side), half, &self.colour, 0.0);
        let redness = self.coded(halved(&redness, side), half, &self.colour, 0.0);
        for (index, &pixel) in visible.pixels.iter().enumerate() {
            let (row, column) = (pixel as usize / visible.size, pixel as usize % visible.size);
            let y = brightness[row * side + column];
            let quarter = row / 2 * half + column / 2;
            let (cb, cr) = (blueness[quarter], redness[quarter]);
            let rgb = [
                y + 1.402 * cr,
                y - 0.344_136 * cb - 0.714_136 * cr,
                y + 1.772 * cb,
            ];
            for (channel, value) in rgb.into_iter().enumerate() {
                let code = (value + 0.5).clamp(0.0, 255.0) as u8;
                light[channel * count + index] = codes.light(code);
            }
        }
    }

    /// A plane after rounding of its coefficients and of its values; `middle` is the grey subtracted.
    fn coded(
        &self,
        mut plane: Vec<f32>,
        side: usize,
        steps: &[f32; AREA],
        middle: f32,
    ) -> Vec<f32> {
        for row in (0..side).step_by(BLOCK) {
            for column in (0..side).step_by(BLOCK) {
                let start = row * side + column;
                let mut block = [[0.0; BLOCK]; BLOCK];
                for (line, values) in block.iter_mut().enumerate() {
                    let place = start + line * side;
                    for (value, &found) in values.iter_mut().zip(&plane[place..place + BLOCK]) {
                        *value = round(found) - middle;
                    }
                }
                let mut waves = self.analysed(&self.analysed(&block));
                for (wave, step) in waves.as_flattened_mut().iter_mut().zip(steps) {
                    *wave = round(*wave / step) * step;
                }
                let block = self.composed(&self.composed(&waves));
                for (line, values) in block.iter().enumerate() {
                    let place = start + line * side;
                    for (target, value) in plane[place..place + BLOCK].iter_mut().zip(values) {
                        *target = round(value + middle).clamp(middle - 128.0, middle + 127.0);
                    }
                }
            }
        }
        plane
    }

    /// Cosine transform of every row, transposed: twice gives the transform of the block.
    fn analysed(&self, block: &[[f32; BLOCK]; BLOCK]) -> [[f32; BLOCK]; BLOCK] {
        std::array::from_fn(|frequency| {
            std::array::from_fn(|row| {
                let products = block[row].iter().zip(&self.cosines[frequency]);
                products.map(|(value, cosine)| value * cosine).sum()
            })
        })
    }

    /// The inverse of [`Self::analysed`].
    fn composed(&self, waves: &[[f32; BLOCK]; BLOCK]) -> [[f32; BLOCK]; BLOCK] {
        std::array::from_fn(|row| {
            std::array::from_fn(|place| {
                (0..BLOCK)
                    .map(|k| waves[k][row] * self.cosines[k][place])
                    .sum()
            })
        })
    }
}

/// Means of two by two pixels.
fn halved(plane: &[f32], side: usize) -> Vec<f32> {
    let half = side / 2;
    (0..half * half)
        .map(|pixel| {
            let place = pixel / half * 2 * side + pixel % half * 2;
            let sum =
                plane[place] + plane[place + 1] + plane[place + side] + plane[place + side + 1];
            0.25 * sum
        })
        .collect()
}

/// To the nearest whole number, halves away from zero.
fn round(value: f32) -> f32 {
    (value + if value < 0.0 { -0.5 } else { 0.5 }) as i32 as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::codecs::jpeg::JpegEncoder;
    use image::{ImageBuffer, Luma};

    /// Grey pictures through a real encoder and decoder at the same quality.
    #[test]
    fn pictures_change_as_real_files_do() {
        let size = 64usize;
        let codes = SrgbCodes::shared();
        for quality in [60u8, 85, 95] {
            let picture = ImageBuffer::from_fn(size as u32, size as u32, |x, y| {
                let (x, y) = (x as f32, y as f32);
                let wave = 120.0 + 60.0 * (x * 0.23).sin() * (y * 0.17).cos();
                let spot = if (x - 40.0).hypot(y - 20.0) < 9.0 {
                    70.0
                } else {
                    0.0
                };
                Luma([(wave + spot) as u8])
            });
            let mut file = Vec::new();
            JpegEncoder::new_with_quality(&mut file, quality)
                .encode_image(&picture)
                .unwrap();
            let real = image::load_from_memory(&file).unwrap().to_luma8();
            let ours = stored(quality, size, |_, pixel| picture.as_raw()[pixel]);
            let (mut lost, mut lost_by_them, mut apart) = (0.0, 0.0, 0.0);
            for pixel in 0..size * size {
                let original = f32::from(picture.as_raw()[pixel]);
                let theirs = f32::from(real.as_raw()[pixel]);
                let ours = f32::from(codes.nearest(ours[pixel]));
                lost += (ours - original).abs();
                lost_by_them += (theirs - original).abs();
                apart += (ours - theirs).abs();
            }
            let codes_apart = apart / (size * size) as f32;
            println!("quality {quality}: lost {lost}, {lost_by_them}; {codes_apart} codes apart");
            // Encoders and decoders round differently: less than half a code.
            assert!((lost / lost_by_them - 1.0).abs() < 0.1, "quality {quality}");
            assert!(codes_apart < 0.5, "quality {quality}");
        }
    }

    /// Colours that change slowly survive, colours that change from pixel to pixel are mixed in fours.
    #[test]
    fn colours_lose_their_detail() {
        let (size, area) = (32usize, 32 * 32);
        let codes = SrgbCodes::shared();
        let flat = [200u8, 90, 40];
        let ours = stored(95, size, |channel, _| flat[channel]);
        for (index, &light) in ours.iter().enumerate() {
            let off = i32::from(codes.nearest(light)) - i32::from(flat[index / area]);
            assert!(off.abs() <= 3, "{off}");
        }
        let striped = |channel: usize, pixel: usize| match (channel, pixel % 2) {
            (0, 0) | (2, 1) => 200,
            _ => 100,
        };
        let ours = stored(95, size, striped);
        let difference = |pixel: usize| {
            f32::from(codes.nearest(ours[pixel])) - f32::from(codes.nearest(ours[2 * area + pixel]))
        };
        // Red minus blue was 100 here and -100 beside.
        assert!(difference(10 * size + 10).abs() < 20.0);
    }

    /// Light after storing a picture of given codes.
    fn stored(quality: u8, size: usize, code: impl Fn(usize, usize) -> u8) -> Vec<f32> {
        let pixels: Vec<u32> = (0..(size * size) as u32).collect();
        let visible = Visible {
            size,
            pixels: &pixels,
        };
        let codes = SrgbCodes::shared();
        let mut light: Vec<f32> = (0..3 * size * size)
            .map(|index| codes.light(code(index / (size * size), index % (size * size))))
            .collect();
        Jpeg::new(f32::from(quality)).store(&mut light, &visible);
        light
    }
}
