//! The stages of a run as JavaScript hears of them.
use normalight_model::PipelineStage;
use serde::Serialize;
use tsify::Tsify;

/// A stage of a run.
#[derive(Debug, Clone, Copy, Serialize, Tsify)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Stage {
    /// Files are decoded, before the pipeline begins.
    Reading,
    /// The light network looks at every photograph.
    Lights,
    /// The normal network looks at every photograph.
    Normals,
    /// Lights are refitted to the normals.
    Refit,
    /// The normal network runs again with the refitted lights.
    #[serde(rename = "final normals")]
    FinalNormals,
    /// Albedo from normals and lights.
    Albedo,
}

impl Stage {
    /// Its name in TypeScript and reports: the pipeline's own.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Reading => "reading",
            Self::Lights => PipelineStage::Lights.name(),
            Self::Normals => PipelineStage::Normals.name(),
            Self::Refit => PipelineStage::Refit.name(),
            Self::FinalNormals => PipelineStage::FinalNormals.name(),
            Self::Albedo => PipelineStage::Albedo.name(),
        }
    }
}

impl From<PipelineStage> for Stage {
    fn from(stage: PipelineStage) -> Self {
        match stage {
            PipelineStage::Lights => Self::Lights,
            PipelineStage::Normals => Self::Normals,
            PipelineStage::Refit => Self::Refit,
            PipelineStage::FinalNormals => Self::FinalNormals,
            PipelineStage::Albedo => Self::Albedo,
        }
    }
}
