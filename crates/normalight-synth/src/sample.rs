use glam::{Mat3, Vec3};
use normalight_core::{
    CoreError, ImageStack, Light, Mask, NormalMap, Samples, StackImage, Transfer,
};

/// Photographs of one object with the truth about it, all of one square size.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Side in pixels.
    pub size: usize,
    /// Linear RGB in 0..=1 as decoded from a camera's file: exposed, noisy, clipped and rounded;
    /// zero outside the mask.
    ///
    /// `[images, 3, size, size]`, rows from the top
    pub images: Vec<f32>,
    /// Which pixels show the object.
    ///
    /// `[size, size]`
    pub mask: Vec<bool>,
    /// Unit normals with z > 0, zero outside the mask.
    ///
    /// `[size, size]`
    pub normals: Vec<Vec3>,
    /// z in pixels, rising towards the camera from an arbitrary zero; NaN outside the mask, and everywhere
    /// in samples of finished photographs.
    ///
    /// `[size, size]`
    pub depth: Vec<f32>,
    /// One light per image; directions from the object's middle. Intensities are those of the scene: the
    /// camera's exposure scales all images by one more factor.
    pub lights: Vec<Light>,
    /// Which of the scene's lamps each image was taken under.
    pub lamps: Vec<usize>,
    /// Takes directions of the scene to those of the sample: crops are turned and mirrored.
    pub axes: Mat3,
}

/// Bits per value of exported images.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BitDepth {
    /// 8 bits, linear.
    Eight,
    /// 16 bits, linear.
    Sixteen,
}

impl Sample {
    /// Black images of nothing.
    pub(crate) fn empty(size: usize, images: usize) -> Self {
        let area = size * size;
        Self {
            size,
            images: vec![0.0; images * 3 * area],
            mask: vec![false; area],
            normals: vec![Vec3::ZERO; area],
            depth: vec![f32::NAN; area],
            lights: Vec::new(),
            lamps: Vec::new(),
            axes: Mat3::IDENTITY,
        }
    }

    /// The photographs as a stack of floating-point images named `001.png` and so on.
    ///
    /// # Errors
    /// Fewer images than a stack needs, or too small ones.
    pub fn to_stack(&self) -> Result<ImageStack, CoreError> {
        ImageStack::new(self.stack_images(Samples::F32))
    }

    /// The photographs as linear integers, ready to be written to files.
    pub fn to_stack_images(&self, depth: BitDepth) -> Vec<StackImage> {
        self.stack_images(|values| match depth {
            BitDepth::Eight => Samples::U8(
                values
                    .iter()
                    .map(|value| (value * 255.0 + 0.5) as u8)
                    .collect(),
            ),
            BitDepth::Sixteen => Samples::U16(
                values
                    .iter()
                    .map(|value| (value * 65535.0 + 0.5) as u16)
                    .collect(),
            ),
        })
    }

    /// The mask as the rest of the project knows it.
    pub fn to_mask(&self) -> Mask {
        Mask::new(self.size, self.size, self.mask.clone())
    }

    /// The normals as the rest of the project knows them.
    pub fn to_normal_map(&self) -> NormalMap {
        NormalMap::new(self.size, self.size, self.normals.clone())
    }

    fn stack_images(&self, store: impl Fn(Vec<f32>) -> Samples) -> Vec<StackImage> {
        let area = self.size * self.size;
        self.images
            .chunks_exact(3 * area)
            .enumerate()
            .map(|(index, planes)| {
                let interleaved = (0..3 * area)
                    .map(|place| planes[place % 3 * area + place / 3])
                    .collect();
                StackImage {
                    name: format!("{:03}.png", index + 1),
                    width: self.size,
                    height: self.size,
                    channels: 3,
                    samples: store(interleaved),
                    transfer: Transfer::Linear,
                }
            })
            .collect()
    }
}
