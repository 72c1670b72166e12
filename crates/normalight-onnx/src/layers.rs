//! Layers as `normalight-model` has them, by the paths of their tensors.
use crate::graph::{GraphBuilder, Value};
use crate::proto::Attribute;
use normalight_model::{LEAK, ModelError};

impl GraphBuilder<'_> {
    /// A convolution with bias and "same" padding.
    pub(crate) fn convolution(
        &mut self,
        path: &str,
        input: &Value,
        stride: usize,
    ) -> Result<Value, ModelError> {
        let (weight, shape) = self.weight(&format!("{path}.weight"))?;
        let (bias, _) = self.weight(&format!("{path}.bias"))?;
        Ok(self.convolve(&[input, &weight, &bias], shape, (stride, 1)))
    }

    /// ReLU, then a depthwise convolution without bias.
    pub(crate) fn depthwise_relu(
        &mut self,
        path: &str,
        input: &Value,
        stride: usize,
    ) -> Result<Value, ModelError> {
        let input = self.relu(input);
        let (weight, shape) = self.weight(&format!("{path}.weight"))?;
        let groups = shape.first().copied().unwrap_or(1);
        Ok(self.convolve(&[&input, &weight], shape, (stride, groups)))
    }

    fn convolve(
        &mut self,
        inputs: &[&Value],
        shape: &[usize],
        (stride, groups): (usize, usize),
    ) -> Value {
        let size = shape.last().map_or(1, |&size| size as i64);
        let attributes = [
            ("kernel_shape", Attribute::Integers(&[size; 2])),
            ("pads", Attribute::Integers(&[size / 2; 4])),
            ("strides", Attribute::Integers(&[stride as i64; 2])),
            ("group", Attribute::Integer(groups as i64)),
        ];
        self.node("Conv", inputs, &attributes)
    }

    pub(crate) fn leaky(&mut self, input: &Value) -> Value {
        self.node("LeakyRelu", &[input], &[("alpha", Attribute::Float(LEAK))])
    }

    /// [`Self::convolution`] and leaky ReLU.
    pub(crate) fn layer(
        &mut self,
        path: &str,
        input: &Value,
        stride: usize,
    ) -> Result<Value, ModelError> {
        let output = self.convolution(path, input, stride)?;
        Ok(self.leaky(&output))
    }

    /// Layers with these strides, one after the other: `path.0`, `path.1` and so on.
    pub(crate) fn row(
        &mut self,
        path: &str,
        input: &Value,
        strides: &[usize],
    ) -> Result<Value, ModelError> {
        let mut value = input.clone();
        for (place, &stride) in strides.iter().enumerate() {
            value = self.layer(&format!("{path}.{place}"), &value, stride)?;
        }
        Ok(value)
    }

    /// Every pixel twice in both directions.
    pub(crate) fn doubled(&mut self, input: &Value) -> Value {
        let scales = self.floats(&[4], &[1.0, 1.0, 2.0, 2.0]);
        let attributes = [
            ("mode", Attribute::Text("nearest")),
            (
                "coordinate_transformation_mode",
                Attribute::Text("asymmetric"),
            ),
            ("nearest_mode", Attribute::Text("floor")),
        ];
        self.node("Resize", &[input, &Self::nothing(), &scales], &attributes)
    }

    /// [`Self::layer`] on the input enlarged by two.
    pub(crate) fn doubled_layer(&mut self, path: &str, input: &Value) -> Result<Value, ModelError> {
        let input = self.doubled(input);
        self.layer(path, &input, 1)
    }

    /// A transposed 4x4 convolution that doubles the sides, and leaky ReLU.
    pub(crate) fn transposed_layer(
        &mut self,
        path: &str,
        input: &Value,
    ) -> Result<Value, ModelError> {
        let (weight, _) = self.weight(&format!("{path}.weight"))?;
        let (bias, _) = self.weight(&format!("{path}.bias"))?;
        let attributes = [
            ("kernel_shape", Attribute::Integers(&[4; 2])),
            ("pads", Attribute::Integers(&[1; 4])),
            ("strides", Attribute::Integers(&[2; 2])),
        ];
        let output = self.node("ConvTranspose", &[input, &weight, &bias], &attributes);
        Ok(self.leaky(&output))
    }

    /// A fully connected layer.
    pub(crate) fn linear(&mut self, path: &str, input: &Value) -> Result<Value, ModelError> {
        let (weight, _) = self.weight(&format!("{path}.weight"))?;
        let (bias, _) = self.weight(&format!("{path}.bias"))?;
        Ok(self.node("Gemm", &[input, &weight, &bias], &[]))
    }

    /// Vectors along the channels at unit length.
    pub(crate) fn unit_length(&mut self, raw: &Value) -> Value {
        let along = [("axes", Attribute::Integers(&[1]))];
        let squares = self.node("ReduceSumSquare", &[raw], &along);
        // As the network itself has it, for its gradient's sake.
        let small = self.floats(&[], &[1e-8]);
        let squares = self.add(&squares, &small);
        let length = self.node("Sqrt", &[&squares], &[]);
        self.node("Div", &[raw, &length], &[])
    }
}
