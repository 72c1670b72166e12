use glam::Vec3;

/// The light of one photograph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Unit vector from the object to the light.
    pub direction: Vec3,
    /// Brightness per colour channel, linear; defined up to one scale for the whole stack.
    pub intensity: [f32; 3],
    /// 0 (no idea) to 1 (certain); given lights have 1.
    pub confidence: f32,
}

impl Light {
    /// A light that is known: grey intensity, confidence 1. The direction is brought to unit length.
    pub fn new(direction: Vec3, intensity: f32) -> Self {
        Self {
            direction: direction.normalize_or(Vec3::Z),
            intensity: [intensity; 3],
            confidence: 1.0,
        }
    }

    /// Mean of the three channels.
    pub fn mean_intensity(&self) -> f32 {
        self.intensity.iter().sum::<f32>() / 3.0
    }
}
