//! The normal network's work, shared with workers that each hold a module of their own.
use js_sys::{Float32Array, Promise, Uint32Array};
use normalight_model::{Helpers, Parcel};
use serde::{Deserialize, Serialize};
use tsify::Tsify;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
#[cfg(feature = "cpu")]
use {
    crate::error::Failure,
    crate::file::InputFile,
    burn::tensor::Device,
    normalight_io::NamedBytes,
    normalight_model::{LoadedNormalNetwork, Weights},
    tsify::Ts,
};

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = "
/** Workers that do a part of the normal network's work. */
export interface HelperPool {
  /** How many there are to be given work. */
  readonly count: number;
  /** Gives work to one of them; nothing where it fails. */
  features(helper: number, shapes: Uint32Array, values: Float32Array): Promise<FeatureParcel | undefined>;
}
";

#[wasm_bindgen]
extern "C" {
    /// Workers that do a part of the normal network's work.
    #[wasm_bindgen(typescript_type = "HelperPool")]
    pub type HelperPool;

    #[wasm_bindgen(method, getter, js_name = count)]
    fn helper_count(this: &HelperPool) -> usize;

    #[wasm_bindgen(method, catch, js_name = features)]
    fn ask(
        this: &HelperPool,
        helper: usize,
        shapes: Vec<u32>,
        values: Vec<f32>,
    ) -> Result<Promise, JsValue>;
}

/// Tensors on their way between workers.
#[derive(Debug, Serialize, Deserialize, Tsify)]
pub struct FeatureParcel {
    /// What the values are.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint32Array<ArrayBuffer>")]
    shapes: Uint32Array,
    /// All tensors' values, one after the other.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Float32Array<ArrayBuffer>")]
    values: Float32Array,
}

impl Helpers for HelperPool {
    fn count(&self) -> usize {
        self.helper_count()
    }

    fn features(&self, helper: usize, work: Parcel) -> impl Future<Output = Option<Parcel>> {
        // Asked before anybody waits for the answer.
        let answer = self.ask(helper, work.shapes, work.values);
        async move {
            let found = JsFuture::from(answer.ok()?).await.ok()?;
            let found: FeatureParcel = serde_wasm_bindgen::from_value(found).ok()?;
            Some(Parcel {
                shapes: found.shapes.to_vec(),
                values: found.values.to_vec(),
            })
        }
    }
}

/// A normal network that computes features for others.
#[cfg(feature = "cpu")]
#[wasm_bindgen]
#[derive(Debug)]
pub struct Helper {
    network: LoadedNormalNetwork,
}

#[cfg(feature = "cpu")]
#[wasm_bindgen]
impl Helper {
    /// With the weights of who is helped.
    ///
    /// # Errors
    /// Weights that are damaged.
    #[wasm_bindgen(constructor)]
    pub fn new(normal: InputFile) -> Result<Helper, Failure> {
        let NamedBytes { name, bytes } = normal.into();
        let weights = Weights::from_bytes(&name, &bytes)?;
        Ok(Self {
            network: weights.normal_network(&Device::flex())?,
        })
    }

    /// Does what a [`HelperPool`] was asked for.
    ///
    /// # Errors
    /// Work of another kind.
    pub async fn features(
        &self,
        shapes: Vec<u32>,
        values: Vec<f32>,
    ) -> Result<Ts<FeatureParcel>, Failure> {
        let found = self.network.features(&Parcel { shapes, values }).await?;
        let found = FeatureParcel {
            shapes: Uint32Array::from(&found.shapes[..]),
            values: Float32Array::from(&found.values[..]),
        };
        Ok(found.into_ts()?)
    }
}
