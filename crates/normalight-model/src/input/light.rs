/// What the light network sees of the images of one stack: linear RGB relative to the stack's mean, so that only the
/// lights' relative brightness is left, and whether the pixel is the object's.
#[derive(Debug, Clone, Copy)]
pub struct LightInput {
    scale: f32,
}

impl LightInput {
    /// Channels of a pixel: R, G, B, mask (1 inside).
    pub const CHANNELS: usize = 4;

    /// `mean`: of the stack over object pixels, images and channels.
    pub fn new(mean: f32) -> Self {
        let scale = 1.0 / mean.max(1e-12);
        Self { scale }
    }

    /// Writes one image.
    ///
    /// # Shapes
    /// - planes: `[3, area]`: linear RGB; what lies outside the object is not read
    /// - inside: `[area]`
    /// - out: `[area, 4]`
    pub fn encode(&self, planes: &[f32], inside: &[bool], out: &mut [f32]) {
        let area = inside.len();
        for (pixel, (out, &inside)) in out.chunks_exact_mut(Self::CHANNELS).zip(inside).enumerate()
        {
            if inside {
                let colour = [0, 1, 2].map(|channel| planes[channel * area + pixel] * self.scale);
                out[..3].copy_from_slice(&colour);
                out[3] = 1.0;
            } else {
                out.fill(0.0);
            }
        }
    }
}
