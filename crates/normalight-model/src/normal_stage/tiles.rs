//! Parts of a stack, as the network sees them.
use crate::{NormalArchitecture, NormalInput, NormalNetwork};
use normalight_core::{CalibratedStack, Light, Mask, Rect, Symmetry, Vec3};

/// Side of the part of a tile that is kept; objects up to this size need one tile. The larger, the less is computed twice
/// where tiles overlap.
const TILE: usize = 512;

/// Rectangles that cover the object's bounding box, those without object left out.
pub(super) fn tiles(mask: &Mask) -> Vec<Rect> {
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
pub(super) struct Tile<'a> {
    calibrated: CalibratedStack<'a>,
    /// The part that is kept of the normals.
    kept: Rect,
    /// The part that the network sees.
    rect: Rect,
    input: NormalInput,
}

impl<'a> Tile<'a> {
    pub(super) fn new(
        calibrated: CalibratedStack<'a>,
        kept: Rect,
        architecture: &NormalArchitecture,
    ) -> Self {
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
pub(super) struct TileView<'a> {
    tile: &'a Tile<'a>,
    symmetry: Symmetry,
    width: usize,
    height: usize,
    /// Where each of the tile's pixels lies in the view, `[rect.height, rect.width]`.
    places: Vec<usize>,
}

impl<'a> TileView<'a> {
    pub(super) fn new(tile: &'a Tile, symmetry: Symmetry) -> Self {
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

    /// The network's input of some images, and its shape.
    ///
    /// # Shapes
    /// `[images, height, width, channels]`
    pub(super) fn batch(&self, images: &[usize]) -> (Vec<f32>, [usize; 4]) {
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
        (values, shape)
    }

    /// Pixels of an image as the network sees it.
    pub(super) fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// Turns the network's output back and adds the kept part of it to the whole map.
    pub(super) fn add(&self, values: &[f32], normals: &mut [Vec3]) {
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
    fn tiles_cover_the_object_once() {
        let (width, height) = (1400, 600);
        let inside: Vec<bool> = (0..width * height)
            .map(|index| {
                let (x, y) = (index % width, index / width);
                (40..1200).contains(&x) && y > 10 && !(600..1040).contains(&x)
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
