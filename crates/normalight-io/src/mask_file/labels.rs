//! Masks of few clear values or colours: labels of parts, palettes.

/// Most values that are labels.
const MOST: usize = 16;

/// Part of the picture that a label covers at least; what is smaller goes with the nearest.
const SMALLEST: usize = 50;

/// The object of a picture of labels.
pub(super) struct Object {
    pub(super) inside: Vec<bool>,
    /// Number of labels that are the object.
    pub(super) parts: usize,
}

/// A value and where it lies.
struct Label {
    colour: [f32; 3],
    /// Pixels of it.
    count: usize,
    /// Pixels of it whose neighbours to the right and below have it too.
    flat: usize,
    /// Pixels of it at the border of the frame.
    border: usize,
}

impl Label {
    /// A surface of its own, not the soft edge between two others.
    fn is_surface(&self, pixels: usize) -> bool {
        2 * self.flat >= self.count && SMALLEST * self.count >= pixels
    }
}

/// The object of a picture that shows labels; `None` where it shows two grey values or no labels.
pub(super) fn object(colours: &[[f32; 3]], width: usize) -> Option<Object> {
    let mut labels: Vec<Label> = Vec::new();
    let mut indices = Vec::with_capacity(colours.len());
    for &colour in colours {
        let known = labels.iter().position(|label| label.colour == colour);
        let index = known.unwrap_or(labels.len());
        if index == MOST {
            return None;
        }
        if known.is_none() {
            labels.push(Label {
                colour,
                count: 0,
                flat: 0,
                border: 0,
            });
        }
        indices.push(index as u8);
    }
    let height = colours.len() / width;
    for (pixel, &index) in indices.iter().enumerate() {
        let (x, y) = (pixel % width, pixel / width);
        let label = &mut labels[usize::from(index)];
        label.count += 1;
        let right = x + 1 == width || indices[pixel + 1] == index;
        let below = y + 1 == height || indices[pixel + width] == index;
        label.flat += usize::from(right && below);
        let edge = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
        label.border += usize::from(edge);
    }
    let surfaces: Vec<&Label> = labels
        .iter()
        .filter(|label| label.is_surface(colours.len()))
        .collect();
    let is_grey = |label: &Label| label.colour.iter().all(|&value| value == label.colour[0]);
    if surfaces.len() < 2 || (surfaces.len() == 2 && labels.iter().all(is_grey)) {
        return None;
    }
    let black = surfaces.iter().find(|label| label.colour == [0.0; 3]);
    let outside = black.or_else(|| surfaces.iter().max_by_key(|label| label.border))?;
    let nearest = surfaces
        .iter()
        .map(|label| distance(label.colour, outside.colour))
        .filter(|&distance| distance > 0.0)
        .fold(f32::MAX, f32::min);
    // Soft edges count as their nearer side.
    let inside: Vec<bool> = labels
        .iter()
        .map(|label| 2.0 * distance(label.colour, outside.colour) > nearest)
        .collect();
    Some(Object {
        inside: indices
            .iter()
            .map(|&index| inside[usize::from(index)])
            .collect(),
        parts: surfaces.len() - 1,
    })
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt()
}
