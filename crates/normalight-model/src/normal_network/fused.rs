use super::staged::sum_over_images;
use burn::tensor::Tensor;
use normalight_kernels::max_over_images;

/// What a normal network keeps of the images of one or more stacks: running values, so that a stack can come in parts and
/// memory does not grow with its images.
#[derive(Debug, Clone)]
pub struct FusedFeatures {
    /// Maximum of the features: `[stacks, height / 2, width / 2, channels]`.
    pub(crate) features: Tensor<4>,
    /// Their sum, in networks that keep their mean.
    pub(super) sum: Option<Tensor<4>>,
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

impl FusedPixels {
    /// Of features `[stacks * images, height, width, channels]`.
    pub(super) fn of(pixels: Tensor<4>, stacks: usize) -> Self {
        Self {
            most: max_over_images(pixels.clone(), stacks),
            sum: sum_over_images(pixels, stacks),
        }
    }

    /// What puts a map of as many stacks beside the maximum and the mean of so many images.
    pub(super) fn beside(self, images: usize) -> impl Fn(Tensor<4>) -> Tensor<4> {
        let mean = self.sum * (1.0 / images as f32);
        move |map| Tensor::cat(vec![map, self.most.clone(), mean.clone()], 3)
    }
}

impl FusedFeatures {
    /// The same of these and more images of the same stacks.
    #[must_use]
    pub fn and(self, more: Self) -> Self {
        let pixels = self.pixels.zip(more.pixels);
        Self {
            sum: self.sum.zip(more.sum).map(|(one, two)| one + two),
            features: self.features.max_pair(more.features),
            pixels: pixels.map(|(one, two)| FusedPixels {
                most: one.most.max_pair(two.most),
                sum: one.sum + two.sum,
            }),
            images: self.images + more.images,
        }
    }

    /// The number of images and all that is kept of them: maximum, sum, and those of single pixels.
    pub(crate) fn into_maps(self) -> (usize, [Option<Tensor<4>>; 4]) {
        let (most, sum) = self.pixels.map(|pixels| (pixels.most, pixels.sum)).unzip();
        (self.images, [Some(self.features), self.sum, most, sum])
    }

    /// What [`FusedFeatures::into_maps`] took apart; `None` without a maximum, or with half of the single pixels'.
    pub(crate) fn from_maps(images: usize, maps: [Option<Tensor<4>>; 4]) -> Option<Self> {
        let [features, sum, most, pixels] = maps;
        Some(Self {
            features: features?,
            sum,
            pixels: match (most, pixels) {
                (Some(most), Some(sum)) => Some(FusedPixels { most, sum }),
                (None, None) => None,
                _ => return None,
            },
            images,
        })
    }

    /// Mean of the features over the images; the maximum where no mean is kept.
    pub(super) fn mean(&self) -> Tensor<4> {
        match &self.sum {
            Some(sum) => sum.clone() * (1.0 / self.images as f32),
            None => self.features.clone(),
        }
    }

    /// Maximum of the features over the images: `[stacks, height / 2, width / 2, channels]`.
    pub fn features(&self) -> Tensor<4> {
        self.features.clone()
    }
}
