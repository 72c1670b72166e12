//! Features of some images, computed elsewhere beside this thread: by workers that share no memory with it.
use crate::light_stage::read_back;
use crate::{FusedFeatures, LoadedNormalNetwork, ModelError};
use burn::tensor::{Device, Tensor, TensorData};

/// Dimensions of a tensor that travels, and tensors that are travelling features: maximum, sum, and those of single pixels.
const RANK: usize = 4;
const MAPS: usize = 4;
/// Numbers before a tensor's values that say what travelling features are: their images, and four shapes.
const HEAD: usize = 1 + MAPS * RANK;

/// Tensors on their way from thread to thread: plain numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Parcel {
    /// What the values are, in the order in which they are packed.
    pub shapes: Vec<u32>,
    /// All tensors' values, one after the other.
    pub values: Vec<f32>,
}

/// Others that compute features of images at the same time, each with the same normal network, see
/// [`LoadedNormalNetwork::features`].
pub trait Helpers {
    /// How many there are to be given work.
    fn count(&self) -> usize;

    /// Gives work to one of them, which begins before this returns. Its answer is `None` where it failed: its work is done
    /// here then.
    fn features(&self, helper: usize, work: Parcel) -> impl Future<Output = Option<Parcel>>;
}

/// Nobody helps.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoHelpers;

impl Helpers for NoHelpers {
    fn count(&self) -> usize {
        0
    }

    async fn features(&self, _helper: usize, _work: Parcel) -> Option<Parcel> {
        None
    }
}

impl<H: Helpers> Helpers for Option<H> {
    fn count(&self) -> usize {
        self.as_ref().map_or(0, Helpers::count)
    }

    fn features(&self, helper: usize, work: Parcel) -> impl Future<Output = Option<Parcel>> {
        let working = self.as_ref().map(|some| some.features(helper, work));
        async move {
            match working {
                Some(working) => working.await,
                None => None,
            }
        }
    }
}

impl LoadedNormalNetwork {
    /// What a helper does: features of the images in a parcel that `estimate` packed.
    ///
    /// # Errors
    /// [`ModelError::Device`], also for a parcel of another kind.
    pub async fn features(&self, work: &Parcel) -> Result<Parcel, ModelError> {
        let mut reader = Reader::new(work, &self.device);
        let (input, before) = reader
            .work()
            .filter(|(input, _)| self.takes(input))
            .ok_or_else(|| ModelError::Device("work of another kind than was expected".into()))?;
        packed(self.network.fuse_after(input, 1, &before)).await
    }

    /// Whether an input has the network's channels and fitting sides.
    fn takes(&self, input: &Tensor<4>) -> bool {
        let [images, height, width, channels] = input.dims();
        let fits = |side: usize| side > 0 && side.is_multiple_of(crate::NormalNetwork::ALIGNMENT);
        images > 0 && fits(height) && fits(width) && channels == self.architecture.input_channels()
    }
}

impl Parcel {
    /// Work for a helper: an input of the network, then what earlier passes kept of all images.
    pub(crate) fn work(values: Vec<f32>, shape: [usize; RANK], before: &[Self]) -> Self {
        let mut work = Self {
            shapes: shape.map(|side| side as u32).to_vec(),
            values,
        };
        for kept in before {
            work.shapes.extend(&kept.shapes);
            work.values.extend(&kept.values);
        }
        work
    }

    /// Features that a helper packed.
    pub(crate) fn features(&self, device: &Device) -> Option<FusedFeatures> {
        let mut reader = Reader::new(self, device);
        reader.features().filter(|_| reader.is_empty())
    }
}

/// Features as numbers.
pub(crate) async fn packed(features: FusedFeatures) -> Result<Parcel, ModelError> {
    let (images, maps) = features.into_maps();
    let mut parcel = Parcel {
        shapes: vec![images as u32],
        values: Vec::new(),
    };
    for map in maps {
        let shape = map.as_ref().map_or([0; RANK], Tensor::dims);
        parcel.shapes.extend(shape.map(|side| side as u32));
        if let Some(map) = map {
            parcel.values.extend(read_back(map).await?);
        }
    }
    Ok(parcel)
}

/// What of a parcel was not taken out yet.
struct Reader<'a> {
    shapes: &'a [u32],
    values: &'a [f32],
    device: &'a Device,
}

impl<'a> Reader<'a> {
    fn new(parcel: &'a Parcel, device: &'a Device) -> Self {
        Self {
            shapes: &parcel.shapes,
            values: &parcel.values,
            device,
        }
    }

    fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// The next tensor, which may be none: `None` where the parcel holds too little.
    fn tensor(&mut self) -> Option<Option<Tensor<RANK>>> {
        let (shape, shapes) = self.shapes.split_first_chunk::<RANK>()?;
        let shape = shape.map(|side| side as usize);
        let size = shape
            .iter()
            .try_fold(1usize, |size, &side| size.checked_mul(side))?;
        let (values, rest) = self.values.split_at_checked(size)?;
        (self.shapes, self.values) = (shapes, rest);
        let data = || TensorData::new(values.to_vec(), shape);
        Some((size > 0).then(|| Tensor::from_data(data(), self.device)))
    }

    fn work(&mut self) -> Option<(Tensor<RANK>, Vec<FusedFeatures>)> {
        let input = self.tensor()??;
        let mut before = Vec::new();
        while !self.is_empty() {
            before.push(self.features()?);
        }
        Some((input, before))
    }

    fn features(&mut self) -> Option<FusedFeatures> {
        if self.shapes.len() < HEAD {
            return None;
        }
        let (&images, shapes) = self.shapes.split_first()?;
        self.shapes = shapes;
        let mut maps = [const { None }; MAPS];
        for map in &mut maps {
            *map = self.tensor()?;
        }
        FusedFeatures::from_maps(images as usize, maps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device() -> Device {
        Device::flex()
    }

    fn map(first: f32) -> Tensor<4> {
        let values: Vec<f32> = (0..24).map(|at| first + at as f32).collect();
        Tensor::from_data(TensorData::new(values, [1, 2, 3, 4]), &device())
    }

    #[test]
    fn features_are_the_same_after_the_way() {
        for maps in [
            [Some(map(1.0)), None, None, None],
            [
                Some(map(1.0)),
                Some(map(2.0)),
                Some(map(3.0)),
                Some(map(4.0)),
            ],
        ] {
            let before = FusedFeatures::from_maps(5, maps).unwrap();
            let parcel = pollster::block_on(packed(before.clone())).unwrap();
            let after = parcel.features(&device()).unwrap();
            let again = pollster::block_on(packed(after)).unwrap();
            assert_eq!(parcel, again);
            assert_eq!(parcel.shapes[..5], [5, 1, 2, 3, 4]);
            assert_eq!(parcel.values.len() % 24, 0);
        }
    }

    #[test]
    fn half_a_parcel_is_none() {
        let whole = FusedFeatures::from_maps(5, [Some(map(1.0)), None, None, None]).unwrap();
        let whole = pollster::block_on(packed(whole)).unwrap();
        let short = |shapes: usize, values: usize| Parcel {
            shapes: whole.shapes[..shapes].to_vec(),
            values: whole.values[..values].to_vec(),
        };
        assert!(short(17, 24).features(&device()).is_some());
        assert!(short(16, 24).features(&device()).is_none());
        assert!(short(17, 23).features(&device()).is_none());
        let huge = Parcel {
            shapes: vec![u32::MAX; 17],
            values: Vec::new(),
        };
        assert!(huge.features(&device()).is_none());
    }
}
