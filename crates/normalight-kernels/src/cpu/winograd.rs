//! 3x3 convolutions of stride 1 by Winograd's F(4x4, 3x3): a quarter of the multiplications.
//!
//! The image is cut into tiles of 4x4 outputs. Each tile's 6x6 inputs are transformed; for each of the 36 points a
//! matrix product over the channels follows, and its result is transformed back. The gradients are the transposes of
//! these steps, so they need a quarter of the multiplications, too.
mod tiles;
mod weights;

use crate::cpu::buffer::Buffer;
use crate::cpu::geometry::{Filter, Geometry, Part, PartGradients};
use crate::cpu::product::{Finish, Left, Product, Right};
use crate::cpu::transforms::{KEPT, POINTS, SIDE, TAPS};
use crate::cpu::vectors::run;
use crate::cpu::window::{Window, add_window, copy_window};
use std::ops::Range;
use tiles::{Gather, Points, Scatter, Spread, Write};
use weights::{WeightGradientTransform, WeightTransform};

/// Floats of a block's transformed tiles, input and output: they stay in the second-level cache.
const BLOCK: usize = 160_000;

/// Channels below which the transforms cost more than they save.
const FEWEST_CHANNELS: usize = 8;

/// Whether this is the fastest way for a convolution.
pub(crate) fn suits(geometry: &Geometry) -> bool {
    let covered =
        geometry.height().next_multiple_of(KEPT) * geometry.width().next_multiple_of(KEPT);
    geometry.size == SIDE + 1 - KEPT
        && geometry.stride == 1
        && geometry.channels_in >= FEWEST_CHANNELS
        && geometry.channels_out >= FEWEST_CHANNELS
        && covered <= 2 * geometry.out_area()
}

/// Transformed weights, 36 planes in the order of the nine that are given.
///
/// # Shapes
/// - weight: `[3, 3, channels_in, channels_out]`, or the channels the other way round
pub(crate) fn transform_weights(weight: &[f32]) -> Buffer {
    let mut points = Buffer::recycled(weight.len() / TAPS * POINTS);
    run(WeightTransform {
        weight,
        points: &mut points,
    });
    points
}

/// Gradients of the weights from those of [`transform_weights`].
pub(crate) fn transform_weight_gradients(points: &[f32]) -> Buffer {
    let mut weight = Buffer::recycled(points.len() / POINTS * TAPS);
    run(WeightGradientTransform {
        points,
        weight: &mut weight,
    });
    weight
}

/// Tile rows of all images of a batch, one after the other.
#[derive(Clone, Copy)]
pub(crate) struct TileRows {
    /// Of one image.
    pub(crate) per_image: usize,
    /// Tiles of one row.
    pub(crate) tiles: usize,
    /// Rows that are worked on together.
    pub(crate) block: usize,
}

impl TileRows {
    pub(crate) fn new(geometry: &Geometry) -> Self {
        let tiles = geometry.width().div_ceil(KEPT);
        let channels = geometry.channels_in + geometry.channels_out;
        Self {
            per_image: geometry.height().div_ceil(KEPT),
            tiles,
            block: (BLOCK / (POINTS * channels * tiles)).max(1),
        }
    }

    /// Output rows of a tile row.
    pub(crate) fn out_rows(&self, geometry: &Geometry, row: usize) -> Range<usize> {
        let first = row % self.per_image * KEPT;
        first..(first + KEPT).min(geometry.height())
    }

    /// What a tile row sees.
    fn window(&self, geometry: &Geometry, row: usize) -> Window {
        Window {
            first_row: (row % self.per_image * KEPT) as isize + geometry.origin,
            rows: SIDE,
            first_column: geometry.origin,
            columns: self.tiles * KEPT + SIDE - KEPT,
        }
    }
}

/// Outputs of some tile rows.
///
/// # Shapes
/// - input: all images
/// - filter: weights of [`transform_weights`]
/// - output: the rows' part of the output
pub(crate) fn forward(
    geometry: &Geometry,
    rows: Range<usize>,
    input: &[f32],
    filter: &Filter<'_>,
    output: &mut [f32],
) {
    let grid = TileRows::new(geometry);
    let (channels_in, channels_out) = (geometry.channels_in, geometry.channels_out);
    let tiles = rows.len() * grid.tiles;
    let (transformed_at, sums_at) = (
        Points {
            tiles,
            channels: channels_in,
        },
        Points {
            tiles,
            channels: channels_out,
        },
    );
    let mut transformed = Buffer::recycled(transformed_at.floats());
    let mut sums = Buffer::recycled(sums_at.floats());
    gather(geometry, &grid, rows.clone(), input, &mut transformed);
    for point in 0..POINTS {
        Product {
            size: [tiles, channels_out],
            counts: [1, channels_in],
            left: Left::rows(&transformed[point * transformed_at.plane()..], channels_in),
            right: Right::rows(
                &filter.weight[point * channels_in * channels_out..],
                channels_out,
            ),
            output: &mut sums[point * sums_at.plane()..],
            output_row: channels_out,
            finish: Finish::Stored,
        }
        .compute();
    }
    let mut from = 0;
    for (index, row) in rows.enumerate() {
        let kept = grid.out_rows(geometry, row).len();
        let floats = kept * geometry.width() * channels_out;
        run(Write {
            points: &sums,
            place: sums_at,
            first: index * grid.tiles,
            tiles: grid.tiles,
            rows: kept,
            columns: geometry.width(),
            bias: filter.bias,
            slope: filter.slope,
            out: &mut output[from..from + floats],
        });
        from += floats;
    }
}

/// Transformed inputs of some tile rows: `[36, tiles, channels_in]`.
fn gather(
    geometry: &Geometry,
    grid: &TileRows,
    rows: Range<usize>,
    input: &[f32],
    points: &mut [f32],
) {
    let channels = geometry.channels_in;
    let place = Points {
        tiles: rows.len() * grid.tiles,
        channels,
    };
    let size = grid.window(geometry, 0).floats(channels);
    let mut patch = Buffer::recycled(size);
    for (index, row) in rows.enumerate() {
        let window = grid.window(geometry, row);
        let image = row / grid.per_image * geometry.image_in();
        let image = &input[image..image + geometry.image_in()];
        copy_window(geometry, window, image, &mut patch);
        run(Gather {
            window: &patch,
            columns: window.columns,
            tiles: grid.tiles,
            points,
            place,
            first: index * grid.tiles,
        });
    }
}

/// Adds the gradients of weights (transformed, `[36, channels_in, channels_out]`) and bias, and writes those of the input.
pub(crate) fn add_gradients(part: &Part<'_>, gradients: &mut PartGradients<'_>) {
    let grid = TileRows::new(part.geometry);
    let images = part.output.len() / part.geometry.image_out();
    let rows = images * grid.per_image;
    for first in (0..rows).step_by(grid.block) {
        let block = first..rows.min(first + grid.block);
        add_block(part, &grid, block, gradients);
    }
}

fn add_block(
    part: &Part<'_>,
    grid: &TileRows,
    rows: Range<usize>,
    gradients: &mut PartGradients<'_>,
) {
    let geometry = part.geometry;
    let (channels_in, channels_out) = (geometry.channels_in, geometry.channels_out);
    let tiles = rows.len() * grid.tiles;
    let (transformed_at, sums_at) = (
        Points {
            tiles,
            channels: channels_in,
        },
        Points {
            tiles,
            channels: channels_out,
        },
    );
    let mut transformed = Buffer::recycled(transformed_at.floats());
    let mut sums = Buffer::recycled(sums_at.floats());
    if !gradients.weight.is_empty() {
        gather(geometry, grid, rows.clone(), part.input, &mut transformed);
    }
    for (index, row) in rows.clone().enumerate() {
        let kept = grid.out_rows(geometry, row);
        let line = geometry.width() * channels_out;
        let from = row / grid.per_image * geometry.image_out() + kept.start * line;
        let place = from..from + kept.len() * line;
        run(Spread {
            output: &part.output[place.clone()],
            gradient: &part.gradient[place],
            slope: part.slope,
            rows: kept.len(),
            columns: geometry.width(),
            bias: gradients.bias,
            points: &mut sums,
            place: sums_at,
            first: index * grid.tiles,
            tiles: grid.tiles,
        });
    }
    for point in 0..POINTS {
        let transformed = &mut transformed[point * transformed_at.plane()..][..tiles * channels_in];
        let sums = &sums[point * sums_at.plane()..];
        if !gradients.weight.is_empty() {
            Product {
                size: [channels_in, channels_out],
                counts: [1, tiles],
                left: Left {
                    values: transformed,
                    row: 1,
                    steps: [0, channels_in],
                },
                right: Right::rows(sums, channels_out),
                output: &mut gradients.weight[point * channels_in * channels_out..],
                output_row: channels_out,
                finish: Finish::Added,
            }
            .compute();
        }
        if gradients.input.is_empty() {
            continue;
        }
        Product {
            size: [tiles, channels_in],
            counts: [1, channels_out],
            left: Left::rows(sums, channels_out),
            right: Right::rows(
                &part.transposed[point * channels_in * channels_out..],
                channels_in,
            ),
            output: transformed,
            output_row: channels_in,
            finish: Finish::Stored,
        }
        .compute();
    }
    if !gradients.input.is_empty() {
        scatter(geometry, grid, rows, &transformed, gradients.input);
    }
}

/// The transpose of [`gather`]: a tile row's values are added to the images, which begin with zeros.
fn scatter(
    geometry: &Geometry,
    grid: &TileRows,
    rows: Range<usize>,
    points: &[f32],
    grad_input: &mut [f32],
) {
    let channels = geometry.channels_in;
    let place = Points {
        tiles: rows.len() * grid.tiles,
        channels,
    };
    let mut patch = Buffer::recycled(grid.window(geometry, 0).floats(channels));
    for (index, row) in rows.enumerate() {
        let window = grid.window(geometry, row);
        run(Scatter {
            points,
            place,
            first: index * grid.tiles,
            tiles: grid.tiles,
            window: &mut patch,
            columns: window.columns,
        });
        let image = row / grid.per_image * geometry.image_in();
        let image = &mut grad_input[image..image + geometry.image_in()];
        if row.is_multiple_of(grid.per_image) {
            image.fill(0.0);
        }
        add_window(geometry, window, &patch, image);
    }
}
