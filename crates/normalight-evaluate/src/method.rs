use serde::{Deserialize, Serialize};

/// A way from photographs to normals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Lights and normals by the networks, as users do it.
    Uncalibrated,
    /// The true lights, normals by the network: what is left is the normal network's error.
    Calibrated,
    /// Lights by the light network and the refit, normals by [least squares](normalight_core::least_squares_normals).
    EstimatedLeastSquares,
    /// The true lights, normals by least squares (Woodham 1980).
    LeastSquares,
    /// The true lights, normals by [robust least squares](normalight_core::robust_normals).
    Robust,
    /// Lights and normals by [factorisation](normalight_core::uncalibrated_factorisation), without any training.
    Factorisation,
}

impl Method {
    /// All of them, those that are not told the lights first.
    pub const ALL: [Self; 6] = [
        Self::Uncalibrated,
        Self::EstimatedLeastSquares,
        Self::Factorisation,
        Self::Calibrated,
        Self::Robust,
        Self::LeastSquares,
    ];

    /// Its name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uncalibrated => "uncalibrated",
            Self::Calibrated => "calibrated",
            Self::EstimatedLeastSquares => "estimated-least-squares",
            Self::LeastSquares => "least-squares",
            Self::Robust => "robust",
            Self::Factorisation => "factorisation",
        }
    }

    /// Its name for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Uncalibrated => "Normalight",
            Self::Calibrated => "True lights, normal network",
            Self::EstimatedLeastSquares => "Estimated lights, least squares",
            Self::LeastSquares => "True lights, least squares",
            Self::Robust => "True lights, robust least squares",
            Self::Factorisation => "Factorisation, no training",
        }
    }

    /// Whether it is told the true lights (calibrated photometric stereo).
    pub fn knows_lights(self) -> bool {
        matches!(self, Self::Calibrated | Self::LeastSquares | Self::Robust)
    }

    /// Which networks it uses: the light network, the normal network.
    pub fn networks(self) -> [bool; 2] {
        match self {
            Self::Uncalibrated => [true; 2],
            // The refit of the lights is to normals of the network.
            Self::EstimatedLeastSquares => [true; 2],
            Self::Calibrated => [false, true],
            Self::LeastSquares | Self::Robust | Self::Factorisation => [false; 2],
        }
    }
}
