use burn::tensor::Tensor;

/// What a normal network keeps of the images of one or more stacks: running values, so that a stack can come in parts and
/// memory does not grow with its images.
#[derive(Debug, Clone)]
pub struct FusedFeatures {
    /// Maximum of the features: `[stacks, height / 2, width / 2, channels]`.
    pub(crate) features: Tensor<4>,
    /// What the branch of single pixels found, in networks that have one.
    pub(super) pixels: Option<FusedPixels>,
    /// Images per stack so far.
    pub(super) images: usize,
}

/// Maximum and sum of single pixels' features: `[stacks, height, width, channels]` each.
#[derive(Debug, Clone)]
pub(super) struct FusedPixels {
    pub(super) most: Tensor<4>,
    pub(super) sum: Tensor<4>,
}

impl FusedFeatures {
    /// The same of these and more images of the same stacks.
    #[must_use]
    pub fn and(self, more: Self) -> Self {
        let pixels = self.pixels.zip(more.pixels);
        Self {
            features: self.features.max_pair(more.features),
            pixels: pixels.map(|(one, two)| FusedPixels {
                most: one.most.max_pair(two.most),
                sum: one.sum + two.sum,
            }),
            images: self.images + more.images,
        }
    }

    /// Maximum of the features over the images: `[stacks, height / 2, width / 2, channels]`.
    pub fn features(&self) -> Tensor<4> {
        self.features.clone()
    }
}
