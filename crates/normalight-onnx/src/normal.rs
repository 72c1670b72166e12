//! The normal estimation network.
use crate::graph::{GraphBuilder, Value};
use crate::proto::{Side, ValueInfo};
use crate::stages::Resize;
use crate::wire::Message;
use normalight_model::{
    CellNormal, Meeting, ModelError, NormalArchitecture, NormalBody, NormalNetwork, PlainNormal,
    StagedNormal, Upsampling, Weights,
};

/// The graph, what goes in and what comes out.
pub(crate) fn graph(
    weights: &Weights,
    architecture: &NormalArchitecture,
) -> Result<(Message, Vec<ValueInfo>), ModelError> {
    let (images, normals) = (images(architecture), normals());
    let mut graph = GraphBuilder::new(weights);
    let input = graph.input(&images);
    let raw = match &architecture.body {
        NormalBody::Plain(body) => plain(&mut graph, body, &input)?,
        NormalBody::Cells(body) => cells(&mut graph, body, &input)?,
        NormalBody::Staged(body) => staged(&mut graph, body, &input)?,
    };
    let unit = graph.unit_length(&raw);
    graph.output(&normals, &unit);
    let infos = vec![images.clone(), normals.clone()];
    Ok((graph.finish("normal", &[images], &[normals])?, infos))
}

fn plain(graph: &mut GraphBuilder, body: &PlainNormal, input: &Value) -> Result<Value, ModelError> {
    let path = "body.Plain";
    let mut value = graph.row(&format!("{path}.down"), input, &[1, 2, 1, 2, 1])?;
    for layer in 0..body.residuals {
        let more = graph.layer(&format!("{path}.residual.{layer}"), &value, 1)?;
        value = graph.add(&value, &more);
    }
    let value = graph.doubled_layer(&format!("{path}.up.0"), &value)?;
    let value = graph.layer(&format!("{path}.up.1"), &value, 1)?;
    let most = graph.over_images("ReduceMax", &value);
    let value = graph.row(&format!("{path}.fused"), &most, &[1, 1])?;
    let head = graph.doubled_layer(&format!("{path}.head"), &value)?;
    let pixel_layers = if body.pixel_branch > 0 { 2 } else { 0 };
    graph.normal_output(path, pixel_layers, input, &head)
}

fn cells(graph: &mut GraphBuilder, body: &CellNormal, input: &Value) -> Result<Value, ModelError> {
    let [normal, reduction, regressor] = body.genotype.required()?.cells();
    let path = |part: &str| format!("body.Cells.{part}");
    let value = graph.row(&path("stem"), input, &body.stem_strides)?;
    let features = [normal, reduction];
    let value = graph.feature_cells(&path("features"), features, body.reductions, &value)?;
    let value = match body.doublings() {
        0 => graph.layer(&path("feature_up.Same"), &value, 1)?,
        _ => up(graph, &path("feature_up"), body.upsampling, &value)?,
    };
    let value = match body.doublings() {
        2 => graph.doubled_layer(&path("feature_conv"), &value)?,
        _ => graph.layer(&path("feature_conv"), &value, 1)?,
    };
    let most = graph.over_images("ReduceMax", &value);
    let value = graph.row(&path("fused"), &most, &vec![1; body.fused_convolutions])?;
    let value = graph.cells(&path("regressor"), &[(regressor, 1); 3], &value)?;
    let value = up(graph, &path("regressor_up"), body.upsampling, &value)?;
    graph.convolution(&path("output"), &value, 1)
}

fn up(
    graph: &mut GraphBuilder,
    path: &str,
    upsampling: Upsampling,
    input: &Value,
) -> Result<Value, ModelError> {
    match upsampling {
        Upsampling::Transposed => graph.transposed_layer(&format!("{path}.Transposed"), input),
        Upsampling::Nearest => graph.doubled_layer(&format!("{path}.Nearest"), input),
    }
}

fn staged(
    graph: &mut GraphBuilder,
    body: &StagedNormal,
    input: &Value,
) -> Result<Value, ModelError> {
    let path = |part: &str| format!("body.Staged.{part}");
    let how = ([Resize::Keep, Resize::Halve], true);
    let value = graph.stages(&path("down"), &body.down, how, input)?;
    let how = ([Resize::Double; 2], false);
    let mut value = graph.stages(&path("up"), &body.up, how, &value)?;
    for exchange in 0..body.exchanges {
        let all = ["ReduceMax", "ReduceMean"].map(|reduction| {
            let shared = graph.over_images(reduction, &value);
            graph.for_each_of(&shared, &value)
        });
        let beside = graph.beside(&[&value, &all[0], &all[1]]);
        value = graph.layer(&path(&format!("exchanges.{exchange}")), &beside, 1)?;
    }
    let most = graph.over_images("ReduceMax", &value);
    let kept = match body.meeting {
        Meeting::Max => most,
        Meeting::MaxMean => {
            let mean = graph.over_images("ReduceMean", &value);
            graph.beside(&[&most, &mean])
        }
    };
    let how = ([Resize::Keep, Resize::Double], false);
    let head = graph.stages(&path("fused"), &body.fused, how, &kept)?;
    let pixel_layers = body.pixels.map_or(0, |pixels| pixels.layers);
    graph.normal_output("body.Staged", pixel_layers, input, &head)
}

impl GraphBuilder<'_> {
    /// The last layer on the head, and on the branch of single pixels in networks that have one.
    fn normal_output(
        &mut self,
        path: &str,
        pixel_layers: usize,
        input: &Value,
        head: &Value,
    ) -> Result<Value, ModelError> {
        let output = format!("{path}.output");
        if pixel_layers == 0 {
            return self.convolution(&output, head, 1);
        }
        let strides = vec![1; pixel_layers];
        let pixels = self.row(&format!("{path}.pixels.layers"), input, &strides)?;
        let most = self.over_images("ReduceMax", &pixels);
        let mean = self.over_images("ReduceMean", &pixels);
        let beside = self.beside(&[head, &most, &mean]);
        let joined = self.layer(&format!("{path}.pixels.join"), &beside, 1)?;
        let beside = self.beside(&[&joined, &most, &mean]);
        self.convolution(&output, &beside, 1)
    }
}

fn images(architecture: &NormalArchitecture) -> ValueInfo {
    let mask = match architecture.mask_channel {
        true => "; 1 at the object's pixels, else 0",
        false => "",
    };
    ValueInfo {
        name: "images",
        shape: vec![
            Side::Free("images"),
            Side::Fixed(architecture.input_channels()),
            Side::Free("height"),
            Side::Free("width"),
        ],
        meaning: format!(
            "All photographs of one object; of more than about 35 make groups with lights from all sides, and average their \
             normals. Height and width are multiples of {}; zeros fill them up at the right and below. Channels: red, green and \
             blue in linear light divided by the intensity of the photograph's light, then each pixel and channel by its root \
             mean square over the photographs, 0 outside the object; x (right), y (up) and z (to the camera) of the unit vector \
             towards the photograph's light, the same at all pixels{mask}.",
            NormalNetwork::ALIGNMENT
        ),
    }
}

fn normals() -> ValueInfo {
    ValueInfo {
        name: "normals",
        shape: vec![
            Side::Fixed(1),
            Side::Fixed(3),
            Side::Free("height"),
            Side::Free("width"),
        ],
        meaning:
            "Unit normals: x right, y up, z to the camera. They mean nothing outside the object."
                .into(),
    }
}
