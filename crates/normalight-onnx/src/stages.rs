//! Networks of stages.
use crate::graph::{GraphBuilder, Value};
use normalight_model::{LayerKind, ModelError, Stage};

/// What the first layer of a stage does to the size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Resize {
    Keep,
    Halve,
    Double,
}

impl GraphBuilder<'_> {
    /// Stages `path.0`, `path.1` and so on: what the first and what each of the others does to the size. `sees_input`: the maps
    /// come from outside.
    pub(crate) fn stages(
        &mut self,
        path: &str,
        stages: &[Stage],
        (resizes, sees_input): ([Resize; 2], bool),
        input: &Value,
    ) -> Result<Value, ModelError> {
        let mut value = input.clone();
        for (place, stage) in stages.iter().enumerate() {
            let how = (resizes[usize::from(place > 0)], sees_input && place == 0);
            value = self.stage(&format!("{path}.{place}"), stage, how, &value)?;
        }
        Ok(value)
    }

    fn stage(
        &mut self,
        path: &str,
        stage: &Stage,
        (resize, is_first): (Resize, bool),
        input: &Value,
    ) -> Result<Value, ModelError> {
        let mut value = input.clone();
        for place in 0..stage.layers {
            let path = format!("{path}.layers.{place}");
            let resize = if place == 0 { resize } else { Resize::Keep };
            // A ReLU would take away the signs of what comes from outside.
            let depthwise = match is_first && place == 0 {
                true => None,
                false => stage.kind.depthwise(),
            };
            let output = self.stage_layer(&path, stage, (depthwise, resize), &value)?;
            value = match stage.residual && place > 0 {
                true => self.add(&value, &output),
                false => output,
            };
        }
        Ok(value)
    }

    fn stage_layer(
        &mut self,
        path: &str,
        stage: &Stage,
        (depthwise, resize): (Option<usize>, Resize),
        input: &Value,
    ) -> Result<Value, ModelError> {
        if resize == Resize::Double && stage.kind == LayerKind::Transposed4 {
            return self.transposed_layer(&format!("{path}.to_width.Transposed"), input);
        }
        let stride = if resize == Resize::Halve { 2 } else { 1 };
        // Where there is a depthwise convolution it has the stride.
        let (mut value, stride) = match depthwise {
            Some(_) => {
                let path = format!("{path}.depthwise");
                (self.depthwise_relu(&path, input, stride)?, 1)
            }
            None => (input.clone(), stride),
        };
        if resize == Resize::Double {
            value = self.doubled(&value);
        }
        let to_width = match stage.normalised {
            true => "to_width.Normed.conv",
            false => "to_width.Biased",
        };
        self.layer(&format!("{path}.{to_width}"), &value, stride)
    }
}
