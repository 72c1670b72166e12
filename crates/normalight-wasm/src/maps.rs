//! Maps of numbers, on their way to JavaScript and back.
use js_sys::Float32Array;
use serde::{Deserialize, Serialize};
use tsify::Tsify;
#[cfg(feature = "cpu")]
use {
    crate::error::Failure,
    normalight_core::{Mask, NormalMap, Vec3},
};

/// Numbers with their shape, rows from the top.
#[derive(Debug, Clone, Serialize, Deserialize, Tsify)]
pub struct FloatMap {
    /// Row after row, the channels of a pixel side by side.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Float32Array<ArrayBuffer>")]
    data: Float32Array,
    /// `[height, width, channels]`.
    shape: [usize; 3],
}

impl FloatMap {
    /// `C` numbers a pixel, from the pixel's place.
    pub(crate) fn new<const C: usize>(
        width: usize,
        height: usize,
        pixel: impl Fn(usize) -> [f32; C],
    ) -> Self {
        let values: Vec<[f32; C]> = (0..width * height).map(pixel).collect();
        Self {
            data: Float32Array::from(values.as_flattened()),
            shape: [height, width, C],
        }
    }
}

#[cfg(feature = "cpu")]
impl FloatMap {
    /// Three numbers a pixel, with width and height.
    fn triples(&self, name: &str) -> Result<(usize, usize, Vec<[f32; 3]>), Failure> {
        let [height, width, channels] = self.shape;
        let (found, expected) = (self.data.length() as usize, height.saturating_mul(width));
        if channels != 3 || expected.checked_mul(3) != Some(found) || found == 0 {
            return Err(Failure::Input(format!(
                "{name}: {found} numbers of shape {:?}, [height, width, 3] expected",
                self.shape
            )));
        }
        let values = self.data.to_vec();
        Ok((width, height, values.as_chunks().0.to_vec()))
    }

    /// As normals, and where there are some.
    ///
    /// # Errors
    /// Numbers of another shape.
    pub(crate) fn normals(&self) -> Result<(NormalMap, Mask), Failure> {
        let (width, height, triples) = self.triples("normalMap")?;
        let normals: Vec<Vec3> = triples.into_iter().map(Vec3::from).collect();
        let map = NormalMap::new(width, height, normals);
        let inside = map.normals().iter().map(|normal| *normal != Vec3::ZERO);
        let mask = Mask::new(width, height, inside.collect());
        Ok((map, mask))
    }

    /// As planes, one a channel.
    ///
    /// # Errors
    /// Numbers of another shape.
    pub(crate) fn planes(&self, name: &str) -> Result<Vec<f32>, Failure> {
        let (.., triples) = self.triples(name)?;
        let plane = |channel: usize| triples.iter().map(move |triple| triple[channel]);
        Ok([0, 1, 2].into_iter().flat_map(plane).collect())
    }
}
