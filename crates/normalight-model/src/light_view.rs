use crate::LightInput;
use normalight_core::{ImageStack, Mask, Rect};

/// The small square view of the masked object that the light network looks at: the object's
/// bounding box, centred, its aspect kept, area-averaged; encoded as [`LightInput`] says.
#[derive(Debug, Clone)]
pub struct LightView {
    size: usize,
    rect: Rect,
    columns: Vec<Span>,
    rows: Vec<Span>,
    /// `[height, width]` of `rect`, 1 inside the object.
    inside: Vec<f32>,
    /// Share of each view pixel that the object covers, `[size, size]`.
    coverage: Vec<f32>,
    /// Whether a view pixel counts as the object's, `[size, size]`.
    covered: Vec<bool>,
    input: LightInput,
}

/// Source pixels that one view pixel covers: first index and weights.
#[derive(Debug, Clone)]
struct Span {
    first: usize,
    weights: Vec<f32>,
}

impl LightView {
    /// Margin around the object, as a share of the view's side.
    pub const MARGIN: f32 = 0.04;

    /// Prepares the view of a stack. The mask must not be empty.
    pub fn new(stack: &ImageStack, mask: &Mask, size: usize) -> Self {
        let whole = Rect::whole(mask.width(), mask.height());
        let rect = mask.bounding_box().unwrap_or(whole);
        let side = rect.width.max(rect.height) as f32 / (1.0 - 2.0 * Self::MARGIN);
        let spans = |length: usize| {
            let start = (length as f32 - side) / 2.0;
            (0..size)
                .map(|k| {
                    let step = side / size as f32;
                    let low = start + k as f32 * step;
                    span(low, low + step, length)
                })
                .collect::<Vec<_>>()
        };
        let (columns, rows) = (spans(rect.width), spans(rect.height));
        let inside = (0..rect.area())
            .map(|index| {
                let (x, y) = (rect.x + index % rect.width, rect.y + index / rect.width);
                f32::from(u8::from(mask.inside()[y * mask.width() + x]))
            })
            .collect();
        let mut view = Self {
            size,
            rect,
            columns,
            rows,
            inside,
            coverage: Vec::new(),
            covered: Vec::new(),
            input: LightInput::new(0.0),
        };
        view.coverage = view.averaged(&view.inside);
        view.covered = view.coverage.iter().map(|&share| share >= 0.5).collect();
        view.input = LightInput::new(view.mean(stack));
        view
    }

    /// Side of the view in pixels.
    pub fn size(&self) -> usize {
        self.size
    }

    /// One image, perhaps with left and right exchanged.
    ///
    /// # Shapes
    /// `out`: `[size, size, 4]`, as [`LightInput`] writes it
    pub fn image(&self, stack: &ImageStack, image: usize, mirrored: bool, out: &mut [f32]) {
        let area = self.rect.area();
        let mut tile = vec![0.0; 3 * area];
        stack.linear_tile(image, self.rect, &mut tile);
        let mut planes = Vec::with_capacity(3 * self.size * self.size);
        for plane in tile.chunks_exact_mut(area) {
            for (value, &inside) in plane.iter_mut().zip(&self.inside) {
                *value *= inside;
            }
            let averaged = self.averaged(plane);
            let pixels = averaged.iter().zip(&self.coverage);
            planes.extend(pixels.map(|(value, coverage)| value / coverage));
        }
        if mirrored {
            let mut covered = self.covered.clone();
            planes
                .chunks_exact_mut(self.size)
                .for_each(<[f32]>::reverse);
            covered
                .chunks_exact_mut(self.size)
                .for_each(<[bool]>::reverse);
            self.input.encode(&planes, &covered, out);
        } else {
            self.input.encode(&planes, &self.covered, out);
        }
    }

    /// Mean over object pixels, channels and images.
    fn mean(&self, stack: &ImageStack) -> f32 {
        let area = self.rect.area();
        let mut tile = vec![0.0; 3 * area];
        let mut sum = 0.0f64;
        for image in 0..stack.len() {
            stack.linear_tile(image, self.rect, &mut tile);
            for plane in tile.chunks_exact(area) {
                let lit = plane.iter().zip(&self.inside);
                sum += lit.map(|(v, m)| f64::from(v * m)).sum::<f64>();
            }
        }
        let count: f32 = self.inside.iter().sum();
        (sum / (3.0 * f64::from(count) * stack.len() as f64)) as f32
    }

    /// Area average of a plane over every view pixel.
    fn averaged(&self, plane: &[f32]) -> Vec<f32> {
        let width = self.rect.width;
        let mut narrow = vec![0.0; self.rect.height * self.size];
        for (line, row) in narrow
            .chunks_exact_mut(self.size)
            .zip(plane.chunks_exact(width))
        {
            for (value, span) in line.iter_mut().zip(&self.columns) {
                *value = span.sum(|k| row[k]);
            }
        }
        let mut out = Vec::with_capacity(self.size * self.size);
        for span in &self.rows {
            out.extend((0..self.size).map(|x| span.sum(|k| narrow[k * self.size + x])));
        }
        out
    }
}

impl Span {
    fn sum(&self, value: impl Fn(usize) -> f32) -> f32 {
        self.weights
            .iter()
            .enumerate()
            .map(|(k, weight)| weight * value(self.first + k))
            .sum()
    }
}

/// Weights of the pixels `0..length` under the interval `low..high`, divided by its length; what
/// hangs over the edge counts as zero.
fn span(low: f32, high: f32, length: usize) -> Span {
    let first = low.floor().max(0.0) as usize;
    let last = (high.ceil().max(0.0) as usize).min(length);
    let weights = (first..last)
        .map(|k| ((k as f32 + 1.0).min(high) - (k as f32).max(low)).max(0.0) / (high - low))
        .collect();
    Span { first, weights }
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_core::{Samples, StackImage, Transfer};

    fn flat_stack(width: usize, height: usize) -> ImageStack {
        let image = |value: f32| StackImage {
            name: "flat".into(),
            width,
            height,
            channels: 1,
            samples: Samples::F32(vec![value; width * height]),
            transfer: Transfer::Linear,
        };
        ImageStack::new(vec![image(0.1), image(0.2), image(0.3)]).unwrap()
    }

    #[test]
    fn flat_images_stay_flat_at_any_scale() {
        for (width, height) in [(7, 5), (64, 20), (200, 300)] {
            let stack = flat_stack(width, height);
            let mask = Mask::whole(width, height);
            let view = LightView::new(&stack, &mask, 32);
            let mut out = vec![0.0; 4 * 32 * 32];
            view.image(&stack, 2, false, &mut out);
            let covered: f32 = out.chunks_exact(4).map(|pixel| pixel[3]).sum();
            let aspect = width.min(height) as f32 / width.max(height) as f32;
            let expected = (32.0 * (1.0 - 2.0 * LightView::MARGIN)).powi(2) * aspect;
            assert!(
                (covered / expected - 1.0).abs() < 0.25,
                "{covered} {expected}"
            );
            for pixel in out.chunks_exact(4) {
                assert!((pixel[0] - 1.5 * pixel[3]).abs() < 1e-4);
            }
        }
    }
}
