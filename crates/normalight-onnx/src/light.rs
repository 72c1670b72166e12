//! The light calibration network.
use crate::graph::{GraphBuilder, Value};
use crate::proto::{Attribute, Side, ValueInfo};
use crate::stages::Resize;
use crate::wire::Message;
use normalight_core::{IntensityBins, IntensitySpacing, LightBins};
use normalight_model::{LightArchitecture, LightBody, LightInput, LightView, ModelError, Weights};
use std::f32::consts::{FRAC_PI_2, PI};

/// The graph, what goes in and what comes out.
pub(crate) fn graph(
    weights: &Weights,
    architecture: &LightArchitecture,
) -> Result<(Message, Vec<ValueInfo>), ModelError> {
    let (images, outputs) = (images(architecture), outputs(&architecture.bins));
    let mut graph = GraphBuilder::new(weights);
    let input = graph.input(&images);
    let own = features(&mut graph, &architecture.body, &input)?;
    let most = graph.over_images("ReduceMax", &own);
    let most = graph.for_each_of(&most, &own);
    let both = graph.beside(&[&own, &most]);
    let last = classifier(&mut graph, &architecture.body, &both)?;
    let flat = graph.node("Flatten", &[&last], &[("axis", Attribute::Integer(1))]);
    let hidden = graph.linear("hidden", &flat)?;
    let hidden = graph.leaky(&hidden);
    let scores = graph.linear("output", &hidden)?;
    let [directions, intensities] = lights(&mut graph, &architecture.bins, &scores);
    for (info, value) in outputs.iter().zip([&directions, &intensities, &scores]) {
        graph.output(info, value);
    }
    let infos = [vec![images.clone()], outputs.clone()].concat();
    Ok((graph.finish("light", &[images], &outputs)?, infos))
}

fn features(
    graph: &mut GraphBuilder,
    body: &LightBody,
    input: &Value,
) -> Result<Value, ModelError> {
    match body {
        LightBody::Plain(_) => graph.row("features.Plain.convolutions", input, &[2, 2, 1, 2, 1]),
        LightBody::Cells(cells) => {
            let [normal, reduction, ..] = cells.genotype.required()?.cells();
            let stem = graph.row("features.Cells.stem", input, &cells.stem_strides)?;
            let path = "features.Cells.cells";
            graph.feature_cells(path, [normal, reduction], cells.reductions, &stem)
        }
        LightBody::Staged(staged) => {
            let how = ([Resize::Halve; 2], true);
            graph.stages("features.Staged", &staged.features, how, input)
        }
    }
}

fn classifier(
    graph: &mut GraphBuilder,
    body: &LightBody,
    both: &Value,
) -> Result<Value, ModelError> {
    match body {
        LightBody::Plain(_) => graph.row("classifier.Plain.convolutions", both, &[1, 2, 2]),
        LightBody::Cells(cells) => {
            let [.., normal, reduction] = cells.genotype.required()?.cells();
            let before = graph.row("classifier.Cells.before", both, &[1, 1])?;
            let cells = [(normal, 1), (reduction, 2)];
            let row = graph.cells("classifier.Cells.cells", &cells, &before)?;
            graph.row("classifier.Cells.after", &row, &[2, 1])
        }
        LightBody::Staged(staged) => {
            let how = ([Resize::Keep, Resize::Halve], false);
            graph.stages("classifier.Staged", &staged.classifier, how, both)
        }
    }
}

/// Directions, `[images, 3]`, and intensities relative to their mean, `[images]`, of the scores: expectations over the classes,
/// as [`LightBins::decode`] has them by soft-argmax.
fn lights(graph: &mut GraphBuilder, bins: &LightBins, scores: &Value) -> [Value; 2] {
    let mut first = 0;
    let mut expectation = |graph: &mut GraphBuilder, centres: &[f32]| {
        let end = first + centres.len();
        let places = [first as i64, end as i64, 1].map(|place| graph.integers(&[place]));
        let [from, to, axis] = &places;
        let part = graph.node("Slice", &[scores, from, to, axis], &[]);
        first = end;
        let shares = graph.node("Softmax", &[&part], &[("axis", Attribute::Integer(1))]);
        let centres = graph.floats(&[centres.len(), 1], centres);
        graph.node("MatMul", &[&shares, &centres], &[])
    };
    let azimuth = expectation(graph, &angles(bins.azimuth));
    let elevation = expectation(graph, &angles(bins.elevation));
    let intensity = expectation(graph, &intensity_centres(&bins.intensity));
    let intensity = match bins.intensity.spacing {
        IntensitySpacing::Linear => intensity,
        IntensitySpacing::Logarithmic => graph.node("Exp", &[&intensity], &[]),
    };
    let mean = graph.over_images("ReduceMean", &intensity);
    let relative = graph.node("Div", &[&intensity, &mean], &[]);
    let flat = graph.integers(&[-1]);
    let relative = graph.node("Reshape", &[&relative, &flat], &[]);

    let mut wave = |operator: &str, angle: &Value| graph.node(operator, &[angle], &[]);
    let [sin_azimuth, cos_azimuth] = ["Sin", "Cos"].map(|operator| wave(operator, &azimuth));
    let [y, cos_elevation] = ["Sin", "Cos"].map(|operator| wave(operator, &elevation));
    let x = graph.node("Mul", &[&sin_azimuth, &cos_elevation], &[]);
    let z = graph.node("Mul", &[&cos_azimuth, &cos_elevation], &[]);
    [graph.beside(&[&x, &y, &z]), relative]
}

/// Centres of classes of angles, in radians.
fn angles(count: usize) -> Vec<f32> {
    let centre = |class: usize| (class as f32 + 0.5) / count as f32 * PI - FRAC_PI_2;
    (0..count).map(centre).collect()
}

/// Centres of the classes on the axis on which they are evenly spaced.
fn intensity_centres(bins: &IntensityBins) -> Vec<f32> {
    let centre = |class: usize| {
        let intensity = bins.at(class as f32 + 0.5);
        match bins.spacing {
            IntensitySpacing::Linear => intensity,
            IntensitySpacing::Logarithmic => intensity.ln(),
        }
    };
    (0..bins.count).map(centre).collect()
}

fn images(architecture: &LightArchitecture) -> ValueInfo {
    let size = architecture.input_size;
    let margin = 100.0 * LightView::MARGIN;
    ValueInfo {
        name: "images",
        shape: vec![
            Side::Free("images"),
            Side::Fixed(LightInput::CHANNELS),
            Side::Fixed(size),
            Side::Fixed(size),
        ],
        meaning: format!(
            "All photographs of one object. The object's bounding box lies in the middle of a square view with a margin of \
             {margin} % on its longer sides, averaged over areas, the object's pixels alone. Channels: red, green and blue in \
             linear light divided by their mean over the object's pixels, channels and photographs; 1 where the object covers \
             half of a pixel or more. All are 0 elsewhere."
        ),
    }
}

fn outputs(bins: &LightBins) -> Vec<ValueInfo> {
    let LightBins {
        azimuth,
        elevation,
        intensity,
    } = bins;
    let spacing = match intensity.spacing {
        IntensitySpacing::Linear => "even steps",
        IntensitySpacing::Logarithmic => "even ratios",
    };
    let info = |name, sides: &[usize], meaning: String| ValueInfo {
        name,
        shape: [Side::Free("images")]
            .into_iter()
            .chain(sides.iter().map(|&side| Side::Fixed(side)))
            .collect(),
        meaning,
    };
    vec![
        info(
            "directions",
            &[3],
            "Unit vector towards each photograph's light: x right, y up, z to the camera.".into(),
        ),
        info("intensities", &[], "Relative to their mean.".into()),
        info(
            "scores",
            &[bins.classes()],
            format!(
                "Of the classes, before softmax: {azimuth} azimuths and {elevation} elevations from -90 to 90 degrees, {} \
                 intensities from {} to {} in {spacing}. The direction is (sin a cos e, sin e, cos a cos e).",
                intensity.count, intensity.low, intensity.high
            ),
        ),
    ]
}
