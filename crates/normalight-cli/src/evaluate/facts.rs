//! What was measured with what.
use crate::args::EvaluateArgs;
use crate::evaluate::folder_name;
use crate::settings::{Estimation, describe};
use normalight_evaluate::{Fact, Method, Table};
use normalight_io::WeightHashes;
use serde::Serialize;

/// All figures, and what they were measured with: the JSON file.
#[derive(Debug, Serialize)]
pub(super) struct Evaluation {
    version: String,
    /// Name of the benchmark's folder.
    data: String,
    /// Which lights the normals were estimated with, in words.
    lights_from: String,
    device: String,
    weights: WeightHashes,
    /// Trainable parameters of the light and of the normal network.
    parameters: [usize; 2],
    settings: serde_json::Map<String, serde_json::Value>,
    /// Objects were scaled down to at most so many pixels.
    size: Option<u32>,
    /// Photographs that were left out, as on the command line.
    left_out: Vec<String>,
    /// One for each method and number of images.
    pub(super) tables: Vec<Table>,
}

impl Evaluation {
    pub(super) fn new(args: &EvaluateArgs, methods: &[Method], estimation: &Estimation) -> Self {
        let mut lights: Vec<&str> = methods.iter().map(|method| lights_of(*method)).collect();
        lights.dedup();
        let used = |network: usize| methods.iter().any(|method| method.networks()[network]);
        let [light, normal] = estimation.estimator.weight_hashes();
        let hash = |used: bool, hash: &str| used.then(|| hash.to_owned());
        let all_given = methods.iter().all(|method| method.knows_lights());
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            data: folder_name(&args.folder),
            lights_from: lights.join("; "),
            device: estimation.device.clone(),
            weights: WeightHashes {
                light: hash(used(0), light),
                normal: hash(used(1), normal),
            },
            parameters: estimation.estimator.parameters(),
            settings: describe(&args.estimation, &estimation.settings, all_given),
            size: args.size,
            left_out: args.leave_out.iter().map(ToString::to_string).collect(),
            tables: Vec::new(),
        }
    }

    /// What the figures were measured with, for people.
    pub(super) fn facts(&self) -> Vec<Fact> {
        let hash = |hash: &Option<String>| hash.clone().unwrap_or_else(|| "not used".to_owned());
        let settings: Vec<String> = self
            .settings
            .iter()
            .map(|(name, value)| format!("{name} {value}").replace('"', ""))
            .collect();
        let [light, normal] = self.parameters;
        let mut facts = vec![
            ("version", format!("normalight {}", self.version)),
            ("data", self.data.clone()),
            ("lights", self.lights_from.clone()),
            ("device", self.device.clone()),
            ("light weights", hash(&self.weights.light)),
            ("normal weights", hash(&self.weights.normal)),
            (
                "parameters",
                format!("light network {light}, normal network {normal}"),
            ),
            ("settings", settings.join(", ")),
            (
                "size",
                self.size.map_or("as photographed".to_owned(), |size| {
                    format!("the object's frame, scaled down to at most {size} pixels")
                }),
            ),
        ];
        if !self.left_out.is_empty() {
            facts.push(("left out", self.left_out.join(", ")));
        }
        facts
            .into_iter()
            .map(|(name, value)| Fact {
                name: name.to_owned(),
                value,
            })
            .collect()
    }

    /// The same before the tables on the standard output.
    pub(super) fn heading(&self) -> String {
        let facts = self.facts();
        let lines: String = facts
            .iter()
            .map(|fact| format!("{:16}{}\n", format!("{}:", fact.name), fact.value))
            .collect();
        format!(
            "{lines}normals and lights: mean error in degrees; <11.25, <22.5, <30: share of pixels under so many degrees\n"
        )
    }
}

/// Which lights a method estimates normals with, in words.
fn lights_of(method: Method) -> &'static str {
    if method.knows_lights() {
        "the true lights (calibrated)"
    } else {
        "estimated from the photographs"
    }
}
