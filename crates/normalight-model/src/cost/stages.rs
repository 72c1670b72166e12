//! What stages cost.
use super::layers::{Cost, biased, conv, transposed};
use crate::{LayerKind, PixelStage, Stage, StagedNormal};

/// Stages in a row for pictures of `area` pixels: `halvings` says how often the first layer of the first stage and of the
/// others halves the size, negative for doubling. Gives the cost, the channels and the area that come out.
pub(super) fn row(
    stages: &[Stage],
    (mut channels, mut area): (usize, usize),
    halvings: [i32; 2],
    sees_input: bool,
) -> (Cost, usize, usize) {
    let mut cost = Cost::default();
    for (place, stage) in stages.iter().enumerate() {
        let before = area;
        let halving = halvings[usize::from(place > 0)];
        area = match halving {
            1 => area / 4,
            -1 => area * 4,
            _ => area,
        };
        for layer in 0..stage.layers {
            let kind = match (sees_input && place == 0 && layer == 0, stage.kind) {
                (true, LayerKind::Separable3 | LayerKind::Separable5) => LayerKind::Convolution3,
                (_, kind) => kind,
            };
            // A depthwise convolution comes before the size is doubled.
            let spatial = if layer == 0 { before.min(area) } else { area };
            let widths = [channels, stage.width];
            let doubles = layer == 0 && halving < 0;
            cost = cost
                + match kind {
                    LayerKind::Transposed4 if doubles => transposed(channels, stage.width, area),
                    kind => one(kind, stage.normalised, widths, (spatial, area)),
                };
            channels = stage.width;
        }
    }
    (cost, channels, area)
}

fn one(
    kind: LayerKind,
    normalised: bool,
    [from, to]: [usize; 2],
    (spatial, area): (usize, usize),
) -> Cost {
    let to_width = match kind {
        LayerKind::Convolution3 | LayerKind::Transposed4 => conv(from, to, area),
        _ => biased(from, to, area),
    };
    let size = kind.depthwise().unwrap_or(0);
    // Normalisation has a scale and a shift in place of the bias.
    Cost {
        parameters: to_width.parameters + size * size * from + if normalised { to } else { 0 },
        multiply_adds: to_width.multiply_adds + (size * size * from * spatial) as u64,
    }
}

/// A normal network: for every image, and once for a stack.
pub(super) fn normal(staged: &StagedNormal, inputs: usize, area: usize) -> (Cost, Cost) {
    let (down, channels, small) = row(&staged.down, (inputs, area), [0, 1], true);
    let (up, meeting, meets) = row(&staged.up, (channels, small), [-1, -1], false);
    let mut images = down + up;
    // Each pass computes the features anew and goes through one exchange more; parameters count once.
    let exchange = conv(3 * meeting, meeting, meets);
    let passes = 1 + staged.exchanges as u64;
    images.parameters += staged.exchanges * exchange.parameters;
    images.multiply_adds =
        passes * images.multiply_adds + (0..passes).sum::<u64>() * exchange.multiply_adds;
    let kept = meeting * staged.meeting.widths();
    let (mut fused, head, _) = row(&staged.fused, (kept, meets), [0, -1], false);
    let mut joined = head;
    if let Some(PixelStage { width, layers }) = staged.pixels {
        images = images + biased(inputs, width, area) + biased(width, width, area) * (layers - 1);
        joined += 2 * width;
        fused = fused + conv(joined, head, area);
    }
    (images, fused + conv(joined, 3, area))
}
