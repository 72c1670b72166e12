use crate::light_stage::read_back;
use crate::observer::{Observer, Progress, Stage};
use crate::{FusedFeatures, ModelError, NormalArchitecture, NormalNetwork};
use burn::tensor::{Device, Tensor, TensorData};
use normalight_core::{ImageStack, Light, Mask, NormalMap, Rect, Vec3};
use std::ops::ControlFlow;

/// Images that go through the network together: bounds the memory, whatever the size of the stack.
const BATCH: usize = 8;

/// Side of the part of a tile that is kept; objects up to this size need one tile.
const TILE: usize = 256;

/// Pixels that a tile sees beyond the part that is kept: more than the networks' receptive field
/// of about 30 pixels, so that tiles leave no seam.
const OVERLAP: usize = 32;

/// Light below this, relative to full scale, counts as none when pixels are normalised.
const DARK: f32 = 1e-6;

/// Estimates the normals of a stack under known lights, tile by tile.
///
/// Each image is divided by its light's intensity, then each pixel and channel by its root mean
/// square over the images (a first pass), which takes the albedo away.
///
/// # Errors
/// [`ModelError::Cancelled`], [`ModelError::Device`] or [`ModelError::Core`].
#[expect(
    clippy::too_many_arguments,
    reason = "one call site per stage, all needed"
)]
pub async fn estimate_normals(
    architecture: &NormalArchitecture,
    network: &NormalNetwork,
    stack: &ImageStack,
    mask: &Mask,
    lights: &[Light],
    device: &Device,
    stage: Stage,
    observer: &mut impl Observer,
) -> Result<NormalMap, ModelError> {
    stack.check_mask(mask, "mask")?;
    if lights.len() != stack.len() {
        return Err(normalight_core::CoreError::LightCount {
            found: lights.len(),
            expected: stack.len(),
        }
        .into());
    }
    let (width, height) = (stack.width(), stack.height());
    let mut normals = vec![Vec3::ZERO; width * height];
    let tiles = tiles(mask);
    let steps = (tiles.len() * stack.len()) as f32;
    for (index, &kept) in tiles.iter().enumerate() {
        let tile = Tile::new(stack, mask, lights, kept);
        let mut fused: Option<FusedFeatures> = None;
        for first in (0..stack.len()).step_by(BATCH) {
            let progress = Progress {
                stage,
                fraction: (index * stack.len() + first) as f32 / steps,
            };
            if observer.report(progress).await == ControlFlow::Break(()) {
                return Err(ModelError::Cancelled);
            }
            let images = first..stack.len().min(first + BATCH);
            let input = tile.batch(stack, lights, images, architecture.mask_channel, device);
            let more = network.fuse(input, 1);
            fused = Some(match fused {
                Some(before) => before.and(more),
                None => more,
            });
        }
        if let Some(fused) = fused {
            let values = read_back(network.regress(fused)).await?;
            tile.keep(&values, kept, mask, &mut normals);
        }
    }
    let progress = Progress {
        stage,
        fraction: 1.0,
    };
    if observer.report(progress).await == ControlFlow::Break(()) {
        return Err(ModelError::Cancelled);
    }
    Ok(NormalMap::new(width, height, normals))
}

/// Rectangles that cover the object's bounding box, those without object left out.
fn tiles(mask: &Mask) -> Vec<Rect> {
    let Some(object) = mask.bounding_box() else {
        return Vec::new();
    };
    let mut tiles = Vec::new();
    for y in (0..object.height).step_by(TILE) {
        for x in (0..object.width).step_by(TILE) {
            let tile = Rect {
                x: object.x + x,
                y: object.y + y,
                width: TILE.min(object.width - x),
                height: TILE.min(object.height - y),
            };
            let touched = (tile.y..tile.y + tile.height).any(|row| {
                let start = row * mask.width() + tile.x;
                mask.inside()[start..start + tile.width].contains(&true)
            });
            if touched {
                tiles.push(tile);
            }
        }
    }
    tiles
}

/// A rectangle of the stack, ready for the network: padded with zeros to a multiple of
/// [`NormalNetwork::ALIGNMENT`].
struct Tile {
    rect: Rect,
    padded_width: usize,
    padded_height: usize,
    inside: Vec<bool>,
    /// Reciprocal of the root mean square over the images, `[3, rect.height, rect.width]`; zero
    /// outside the object.
    scale: Vec<f32>,
}

impl Tile {
    fn new(stack: &ImageStack, mask: &Mask, lights: &[Light], kept: Rect) -> Self {
        let rect = kept.grown(OVERLAP, stack.width(), stack.height());
        let inside: Vec<bool> = (0..rect.area())
            .map(|index| {
                let (x, y) = (rect.x + index % rect.width, rect.y + index / rect.width);
                mask.inside()[y * mask.width() + x]
            })
            .collect();
        let mut scale = vec![0.0; 3 * rect.area()];
        let mut values = vec![0.0; 3 * rect.area()];
        for (image, light) in lights.iter().enumerate() {
            stack.linear_tile(image, rect, &mut values);
            for (channel, (sums, plane)) in scale
                .chunks_exact_mut(rect.area())
                .zip(values.chunks_exact(rect.area()))
                .enumerate()
            {
                let factor = 1.0 / light.intensity[channel].max(f32::MIN_POSITIVE);
                for (sum, value) in sums.iter_mut().zip(plane) {
                    *sum += (value * factor).powi(2);
                }
            }
        }
        for plane in scale.chunks_exact_mut(rect.area()) {
            for (sum, &inside) in plane.iter_mut().zip(&inside) {
                let rms = (*sum / lights.len() as f32).sqrt();
                *sum = if inside && rms > DARK { 1.0 / rms } else { 0.0 };
            }
        }
        Self {
            rect,
            padded_width: rect.width.next_multiple_of(NormalNetwork::ALIGNMENT),
            padded_height: rect.height.next_multiple_of(NormalNetwork::ALIGNMENT),
            inside,
            scale,
        }
    }

    /// # Shapes
    /// `[images, padded height, padded width, 6 or 7]`
    fn batch(
        &self,
        stack: &ImageStack,
        lights: &[Light],
        images: std::ops::Range<usize>,
        mask_channel: bool,
        device: &Device,
    ) -> Tensor<4> {
        let (width, height) = (self.padded_width, self.padded_height);
        let count = images.len();
        let channels = 6 + usize::from(mask_channel);
        let mut values = vec![0.0; count * channels * width * height];
        let mut plain = vec![0.0; 3 * self.rect.area()];
        let outs = values.chunks_exact_mut(channels * width * height);
        for (image, out) in images.zip(outs) {
            stack.linear_tile(image, self.rect, &mut plain);
            let light = &lights[image];
            for pixel in out.chunks_exact_mut(channels) {
                pixel[3..6].copy_from_slice(&light.direction.to_array());
            }
            for row in 0..self.rect.height {
                let line = &mut out[row * width * channels..][..self.rect.width * channels];
                for channel in 0..3 {
                    let factor = 1.0 / light.intensity[channel].max(f32::MIN_POSITIVE);
                    let start = channel * self.rect.area() + row * self.rect.width;
                    let source = start..start + self.rect.width;
                    let scaled = plain[source.clone()].iter().zip(&self.scale[source]);
                    for (pixel, (value, scale)) in line.chunks_exact_mut(channels).zip(scaled) {
                        pixel[channel] = value * factor * scale;
                    }
                }
                if mask_channel {
                    let inside = &self.inside[row * self.rect.width..];
                    for (pixel, &inside) in line.chunks_exact_mut(channels).zip(inside) {
                        pixel[6] = f32::from(u8::from(inside));
                    }
                }
            }
        }
        let data = TensorData::new(values, [count, height, width, channels]);
        Tensor::from_data(data, device)
    }

    /// Copies the kept part of the network's output to the whole map.
    fn keep(&self, values: &[f32], kept: Rect, mask: &Mask, normals: &mut [Vec3]) {
        for y in kept.y..kept.y + kept.height {
            for x in kept.x..kept.x + kept.width {
                let target = y * mask.width() + x;
                if mask.inside()[target] {
                    let source = (y - self.rect.y) * self.padded_width + (x - self.rect.x);
                    normals[target] = Vec3::from_slice(&values[3 * source..]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_the_object_once() {
        let (width, height) = (700, 300);
        let inside: Vec<bool> = (0..width * height)
            .map(|index| {
                let (x, y) = (index % width, index / width);
                (20..600).contains(&x) && y > 10 && !(300..520).contains(&x)
            })
            .collect();
        let mask = Mask::new(width, height, inside);
        let mut covered = vec![0; width * height];
        for tile in tiles(&mask) {
            for y in tile.y..tile.y + tile.height {
                for x in tile.x..tile.x + tile.width {
                    covered[y * width + x] += 1;
                }
            }
        }
        for (count, &inside) in covered.iter().zip(mask.inside()) {
            assert!(*count <= 1 && (*count == 1 || !inside));
        }
    }
}
