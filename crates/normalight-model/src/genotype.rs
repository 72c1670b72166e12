use crate::ModelError;
use serde::{Deserialize, Serialize};

/// Candidate operations on an edge: the paper's set, and a plain 3x3 convolution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Operation {
    /// Separable convolution with a 1x1 kernel.
    #[serde(rename = "separable_1x1")]
    Separable1,
    /// Separable convolution with a 3x3 kernel.
    #[serde(rename = "separable_3x3")]
    Separable3,
    /// Separable convolution with a 5x5 kernel.
    #[serde(rename = "separable_5x5")]
    Separable5,
    /// ReLU, plain 3x3 convolution, batch norm: not in the paper's set.
    #[serde(rename = "convolution_3x3")]
    Convolution3,
    /// The identity; at stride 2 a factorised reduction.
    #[serde(rename = "skip")]
    Skip,
    /// No connection.
    #[serde(rename = "zero")]
    Zero,
}

impl Operation {
    /// All operations there are.
    pub const ALL: [Self; 6] = [
        Self::Separable1,
        Self::Separable3,
        Self::Separable5,
        Self::Convolution3,
        Self::Skip,
        Self::Zero,
    ];

    /// The operations that the paper searches among.
    pub const PAPER: [Self; 5] = [
        Self::Separable1,
        Self::Separable3,
        Self::Separable5,
        Self::Skip,
        Self::Zero,
    ];

    /// The name in genotype files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Separable1 => "separable_1x1",
            Self::Separable3 => "separable_3x3",
            Self::Separable5 => "separable_5x5",
            Self::Convolution3 => "convolution_3x3",
            Self::Skip => "skip",
            Self::Zero => "zero",
        }
    }
}

/// One incoming edge of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edge {
    /// What is applied.
    pub operation: Operation,
    /// Where the input comes from: 0 is the output of the cell before the last, 1 that of the last
    /// cell, `2 + k` is node `k` of this cell.
    pub from: usize,
}

/// A searched cell: a directed acyclic graph whose nodes each sum two edges.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// The nodes in order; a node may read only cell inputs and earlier nodes.
    pub nodes: Vec<[Edge; 2]>,
}

/// Cells of the light calibration network.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightGenotype {
    /// Normal cell of the feature block.
    pub feature_normal: Cell,
    /// Reduction cell of the feature block.
    pub feature_reduction: Cell,
    /// Normal cell of the classifier block.
    pub classifier_normal: Cell,
    /// Reduction cell of the classifier block.
    pub classifier_reduction: Cell,
}

/// Cells of the normal estimation network.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NormalGenotype {
    /// Normal cell of the feature block.
    pub feature_normal: Cell,
    /// Reduction cell of the feature block.
    pub feature_reduction: Cell,
    /// Normal cell of the regressor block.
    pub regressor_normal: Cell,
}

/// A genotype file: cells of one or both networks.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Genotypes {
    /// Where the cells come from.
    pub source: String,
    /// Cells of the light calibration network.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub light: Option<LightGenotype>,
    /// Cells of the normal estimation network.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<NormalGenotype>,
}

/// Most nodes a cell may have: far above any published search space.
pub(crate) const MAX_NODES: usize = 16;

impl Cell {
    /// Checks that there are nodes and that every edge reads a cell input or an earlier node.
    ///
    /// # Errors
    /// [`ModelError::Architecture`] naming the cell, the node and the rule.
    pub fn validate(&self, name: &str) -> Result<(), ModelError> {
        if self.nodes.is_empty() || self.nodes.len() > MAX_NODES {
            return Err(ModelError::Architecture {
                what: format!("{name}: number of nodes"),
                found: self.nodes.len().to_string(),
                expected: format!("1 to {MAX_NODES}"),
            });
        }
        for (node, edges) in self.nodes.iter().enumerate() {
            for edge in edges {
                let rule = if edge.from >= 2 + self.nodes.len() {
                    format!("the cell has {} nodes", self.nodes.len())
                } else if edge.from >= 2 + node {
                    "a cell input or an earlier node, so that there is no cycle".to_owned()
                } else {
                    continue;
                };
                return Err(ModelError::Architecture {
                    what: format!("{name}: input of node {node}"),
                    found: edge.from.to_string(),
                    expected: format!("0 to {}: {rule}", node + 1),
                });
            }
        }
        Ok(())
    }
}

impl LightGenotype {
    /// Names of the cells, in the order of [`Self::cells`].
    pub const CELLS: [&str; 4] = [
        "feature_normal",
        "feature_reduction",
        "classifier_normal",
        "classifier_reduction",
    ];

    /// All cells.
    pub fn cells(&self) -> [&Cell; 4] {
        [
            &self.feature_normal,
            &self.feature_reduction,
            &self.classifier_normal,
            &self.classifier_reduction,
        ]
    }

    /// From all cells.
    pub fn from_cells(cells: [Cell; 4]) -> Self {
        let [
            feature_normal,
            feature_reduction,
            classifier_normal,
            classifier_reduction,
        ] = cells;
        Self {
            feature_normal,
            feature_reduction,
            classifier_normal,
            classifier_reduction,
        }
    }

    /// Checks every cell.
    ///
    /// # Errors
    /// [`ModelError::Architecture`].
    pub fn validate(&self) -> Result<(), ModelError> {
        validate_all("light", &Self::CELLS, &self.cells())
    }
}

impl NormalGenotype {
    /// Names of the cells, in the order of [`Self::cells`].
    pub const CELLS: [&str; 3] = ["feature_normal", "feature_reduction", "regressor_normal"];

    /// All cells.
    pub fn cells(&self) -> [&Cell; 3] {
        [
            &self.feature_normal,
            &self.feature_reduction,
            &self.regressor_normal,
        ]
    }

    /// From all cells.
    pub fn from_cells(cells: [Cell; 3]) -> Self {
        let [feature_normal, feature_reduction, regressor_normal] = cells;
        Self {
            feature_normal,
            feature_reduction,
            regressor_normal,
        }
    }

    /// Checks every cell.
    ///
    /// # Errors
    /// [`ModelError::Architecture`].
    pub fn validate(&self) -> Result<(), ModelError> {
        validate_all("normal", &Self::CELLS, &self.cells())
    }
}

fn validate_all(network: &str, names: &[&str], cells: &[&Cell]) -> Result<(), ModelError> {
    for (name, cell) in names.iter().zip(cells) {
        cell.validate(&format!("{network} network, cell {name}"))?;
    }
    Ok(())
}

impl Genotypes {
    /// Reads and validates a genotype file.
    ///
    /// # Errors
    /// [`ModelError::Json`] or [`ModelError::Architecture`].
    pub fn from_json(name: &str, json: &str) -> Result<Self, ModelError> {
        let genotypes: Self = serde_json::from_str(json).map_err(|reason| ModelError::Json {
            name: name.to_owned(),
            reason,
        })?;
        if let Some(light) = &genotypes.light {
            light.validate()?;
        }
        if let Some(normal) = &genotypes.normal {
            normal.validate()?;
        }
        Ok(genotypes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_genotypes_are_refused_with_the_reason() {
        let error = Genotypes::from_json(
            "g.json",
            r#"{"source": "", "normal": {"feature_normal": {"nodes": []}}}"#,
        );
        assert!(
            error
                .unwrap_err()
                .to_string()
                .contains("g.json: missing field")
        );
        let cyclic = Cell {
            nodes: vec![[
                Edge {
                    operation: Operation::Skip,
                    from: 0,
                },
                Edge {
                    operation: Operation::Skip,
                    from: 2,
                },
            ]],
        };
        let message = cyclic.validate("cell").unwrap_err().to_string();
        assert!(message.contains("input of node 0: found 2"), "{message}");
        let unknown = r#"{"source": "", "light": {"feature_normal": {"nodes": [[{"operation": "pool", "from": 0}]]}}}"#;
        let message = Genotypes::from_json("g.json", unknown)
            .unwrap_err()
            .to_string();
        assert!(message.contains("unknown variant `pool`"), "{message}");
        assert!(Cell { nodes: vec![] }.validate("cell").is_err());
        let mut missing = cyclic;
        missing.nodes[0][1].from = 3;
        let message = missing.validate("cell").unwrap_err().to_string();
        assert!(message.contains("the cell has 1 nodes"), "{message}");
        let cell =
            r#"{"nodes": [[{"operation": "skip", "from": 0}, {"operation": "zero", "from": 1}]]}"#;
        let normal = |cells: &str| format!(r#"{{"source": "", "normal": {{{cells}}}}}"#);
        let three = NormalGenotype::CELLS.map(|name| format!(r#""{name}": {cell}"#));
        assert!(Genotypes::from_json("g.json", &normal(&three.join(", "))).is_ok());
        for (cells, reason) in [
            (three[..2].join(", "), "missing field `regressor_normal`"),
            (
                three.join(", ") + &format!(r#", "head": {cell}"#),
                "unknown field `head`",
            ),
        ] {
            let error = Genotypes::from_json("g.json", &normal(&cells)).unwrap_err();
            assert!(error.to_string().contains(reason), "{error}");
        }
    }
}
