use crate::light_stage::read_back;
use crate::observer::{Observer, PipelineStage, report};
use crate::{
    FusedFeatures, LoadedNormalNetwork, ModelError, NormalArchitecture, NormalInput, NormalNetwork,
};
use burn::tensor::{Device, Tensor, TensorData};
use normalight_core::{
    CalibratedStack, Light, Mask, NormalMap, Rect, Symmetry, Vec3, spread_order,
};

/// Images that go through the network together: bounds the memory, whatever the size of the stack.
const BATCH: usize = 8;

/// Images, about, whose features meet in one maximum. Trainings show a network at most some twenty images a
/// sample; the maximum over a hundred lies beyond what it has seen, and one odd image decides it.
const GROUP: usize = 24;

/// Side of the part of a tile that is kept; objects up to this size need one tile.
const TILE: usize = 256;

/// Normals, and how far apart those are that they are means of.
#[derive(Debug, Clone, PartialEq)]
pub struct AveragedNormals {
    /// Unit normals, zero outside the mask.
    pub normals: NormalMap,
    /// Root mean square angle in degrees between a pixel's normal in one view and group of images and their mean, one a
    /// pixel, rows from the top, zero outside the mask. `None` where there is only one.
    pub spread: Option<Vec<f32>>,
}

impl LoadedNormalNetwork {
    /// Estimates the normals of a stack under known lights, tile by tile, as [`NormalInput`] encodes it.
    ///
    /// The network looks at the photographs in each of the `views` (one at least), and the normals, turned back, are
    /// averaged: what it errs differently in each view goes. One view costs as much as the next. More than 35 images are
    /// dealt into groups of about 24, each with normals of its own, which are averaged as well.
    ///
    /// # Errors
    /// [`ModelError::Cancelled`] or [`ModelError::Device`].
    pub async fn estimate(
        &self,
        calibrated: CalibratedStack<'_>,
        views: &[Symmetry],
        stage: PipelineStage,
        observer: &mut impl Observer,
    ) -> Result<AveragedNormals, ModelError> {
        let (stack, mask) = (calibrated.stack(), calibrated.mask());
        let (width, height) = (stack.width(), stack.height());
        let mut normals = vec![Vec3::ZERO; width * height];
        let tiles = tiles(mask);
        let groups = groups(stack.len());
        let passes = self.network.passes();
        let steps = (tiles.len() * views.len() * stack.len() * passes) as f32;
        let mut done = 0;
        for &kept in &tiles {
            let tile = Tile::new(calibrated, kept, &self.architecture);
            for &symmetry in views {
                let view = TileView::new(&tile, symmetry);
                for group in &groups {
                    let mut kept: Vec<FusedFeatures> = Vec::new();
                    for _ in 0..passes {
                        let mut fused: Option<FusedFeatures> = None;
                        for images in group.chunks(BATCH) {
                            report(observer, stage, done as f32 / steps).await?;
                            done += images.len();
                            let input = view.batch(images, &self.device);
                            let more = self.network.fuse_after(input, 1, &kept);
                            fused = Some(match fused {
                                Some(before) => before.and(more),
                                None => more,
                            });
                        }
                        kept.extend(fused);
                    }
                    if let Some(fused) = kept.pop() {
                        let values = read_back(self.network.regress(fused)).await?;
                        view.add(&values, &mut normals);
                    }
                }
            }
        }
        let votes = views.len() * groups.len();
        let spread = (votes > 1).then(|| spread(&normals, votes));
        if votes > 1 {
            for (normal, &inside) in normals.iter_mut().zip(mask.inside()) {
                if inside {
                    *normal = normal.normalize_or(Vec3::Z);
                }
            }
        }
        report(observer, stage, 1.0).await?;
        Ok(AveragedNormals {
            normals: NormalMap::new(width, height, normals),
            spread,
        })
    }
}

/// Root mean square angle in degrees between unit vectors and their mean, of the sums of `votes` of them each; as an estimate
/// of what more of them would have.
fn spread(sums: &[Vec3], votes: usize) -> Vec<f32> {
    let votes = votes as f32;
    let spread = |sum: &Vec3| {
        let apart = (1.0 - sum.length() / votes).max(0.0);
        // For small angles a vector at angle a adds cos a = 1 - a^2 / 2 to the sum.
        (2.0 * apart * votes / (votes - 1.0)).sqrt().to_degrees()
    };
    let inside = |sum: &Vec3| if *sum == Vec3::ZERO { 0.0 } else { spread(sum) };
    sums.iter().map(inside).collect()
}

/// Deals images into groups of about [`GROUP`], each with lights from all sides.
fn groups(images: usize) -> Vec<Vec<usize>> {
    let count = ((images + GROUP / 2) / GROUP).max(1);
    let order = spread_order(images);
    (0..count)
        .map(|group| {
            let mut group = order[group * images / count..(group + 1) * images / count].to_vec();
            group.sort_unstable();
            group
        })
        .collect()
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

/// A rectangle of the stack, and what is the same in all its views.
struct Tile<'a> {
    calibrated: CalibratedStack<'a>,
    /// The part that is kept of the normals.
    kept: Rect,
    /// The part that the network sees.
    rect: Rect,
    input: NormalInput,
}

impl<'a> Tile<'a> {
    fn new(calibrated: CalibratedStack<'a>, kept: Rect, architecture: &NormalArchitecture) -> Self {
        let (stack, mask) = (calibrated.stack(), calibrated.mask());
        let rect = kept.grown(architecture.overlap(), stack.width(), stack.height());
        let inside = (0..rect.area()).map(|index| {
            let (x, y) = (rect.x + index % rect.width, rect.y + index / rect.width);
            mask.inside()[y * mask.width() + x]
        });
        let read = |image: usize, planes: &mut [f32]| stack.linear_tile(image, rect, planes);
        Self {
            calibrated,
            kept,
            rect,
            input: NormalInput::new(
                architecture.mask_channel,
                inside.collect(),
                calibrated.lights(),
                read,
            ),
        }
    }
}

/// A tile turned and mirrored, ready for the network: padded with zeros to a multiple of
/// [`NormalNetwork::ALIGNMENT`]. The padding comes last, so that the network sees the same, at the
/// same place, as in a stack of turned photographs.
struct TileView<'a> {
    tile: &'a Tile<'a>,
    symmetry: Symmetry,
    width: usize,
    height: usize,
    /// Where each of the tile's pixels lies in the view, `[rect.height, rect.width]`.
    places: Vec<usize>,
}

impl<'a> TileView<'a> {
    fn new(tile: &'a Tile, symmetry: Symmetry) -> Self {
        let rect = tile.rect;
        let (width, height) = symmetry.size(rect.width, rect.height);
        let width = width.next_multiple_of(NormalNetwork::ALIGNMENT);
        let height = height.next_multiple_of(NormalNetwork::ALIGNMENT);
        let place = |index: usize| {
            let (x, y) = (index % rect.width, index / rect.width);
            let (x, y) = symmetry.pixel(x, y, rect.width, rect.height);
            y * width + x
        };
        Self {
            tile,
            symmetry,
            width,
            height,
            places: (0..rect.area()).map(place).collect(),
        }
    }

    /// # Shapes
    /// `[images, height, width, channels]`
    fn batch(&self, images: &[usize], device: &Device) -> Tensor<4> {
        let Tile {
            calibrated,
            rect,
            input,
            ..
        } = self.tile;
        let channels = input.channel_count();
        let shape = [images.len(), self.height, self.width, channels];
        let mut values = vec![0.0; shape.iter().product()];
        let mut planes = vec![0.0; 3 * rect.area()];
        let outs = values.chunks_exact_mut(channels * self.width * self.height);
        for (&image, out) in images.iter().zip(outs) {
            calibrated.stack().linear_tile(image, *rect, &mut planes);
            let light = calibrated.lights()[image];
            let turned = Light {
                direction: self.symmetry.vector(light.direction),
                ..light
            };
            input.encode(&planes, &turned, |pixel| self.places[pixel], out);
        }
        Tensor::from_data(TensorData::new(values, shape), device)
    }

    /// Turns the network's output back and adds the kept part of it to the whole map.
    fn add(&self, values: &[f32], normals: &mut [Vec3]) {
        let (back, mask) = (self.symmetry.inverse(), self.tile.calibrated.mask());
        let Tile { kept, rect, .. } = self.tile;
        for y in kept.y..kept.y + kept.height {
            for x in kept.x..kept.x + kept.width {
                let target = y * mask.width() + x;
                if mask.inside()[target] {
                    let place = self.places[(y - rect.y) * rect.width + (x - rect.x)];
                    normals[target] += back.vector(Vec3::from_slice(&values[3 * place..]));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_is_the_angle_between_votes() {
        // Two votes, each `a` from their mean: with one degree of freedom less, a times the root of two.
        let at =
            |degrees: f32| Vec3::new(degrees.to_radians().sin(), 0.0, degrees.to_radians().cos());
        let found = spread(&[at(-6.0) + at(6.0), at(3.0) + at(3.0), Vec3::ZERO], 2);
        assert!((found[0] - 6.0 * 2f32.sqrt()).abs() < 0.02, "{found:?}");
        assert!(found[1] < 0.05 && found[2] == 0.0);
    }

    #[test]
    fn groups_hold_every_image_once() {
        for images in 1..200 {
            let groups = groups(images);
            let mut dealt = groups.concat();
            dealt.sort_unstable();
            assert_eq!(dealt, (0..images).collect::<Vec<_>>());
            for group in &groups {
                assert!(
                    group.len() <= 36,
                    "{images} images: group of {}",
                    group.len()
                );
                assert!(
                    images < 36 || group.len() >= 18,
                    "{images}: {}",
                    group.len()
                );
            }
        }
    }

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
