use crate::Symmetry;
use serde::{Deserialize, Serialize};

/// Over how many views of the photographs an estimate is averaged.
///
/// A view is turned or mirrored, and the world with it, so the truth is the same in all of them; the
/// networks err a little differently in each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum Quality {
    /// One view.
    Fast,
    /// The four views of mirrorings; for the lights two, left and right exchanged.
    #[default]
    Default,
    /// All eight views; for the lights two.
    Best,
}

impl Quality {
    /// All of them, the quickest first.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Default, Self::Best];

    /// Its name in settings and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Default => "default",
            Self::Best => "best",
        }
    }

    /// What it does, costs and gains, for people. Measured on rendered objects that training never
    /// showed, 12 images, on a processor.
    pub fn words(self) -> &'static str {
        match self {
            Self::Fast => "one view of the photographs",
            Self::Default => {
                "mean over four mirrored views: twice the time, normals better by 0.6 degrees"
            }
            Self::Best => {
                "mean over all eight mirrored and turned views: six times the time, better by 0.7 degrees"
            }
        }
    }

    /// Views that the final normals are averaged over.
    pub fn views(self) -> &'static [Symmetry] {
        match self {
            Self::Fast => &Symmetry::ALL[..1],
            Self::Default => &Symmetry::ALL[..4],
            Self::Best => &Symmetry::ALL,
        }
    }

    /// Views that the normals to which lights are refitted are averaged over.
    pub fn refit_views(self) -> &'static [Symmetry] {
        match self {
            Self::Fast | Self::Default => &Symmetry::ALL[..1],
            Self::Best => &Symmetry::ALL,
        }
    }

    /// Whether the lights are averaged over the photographs and their mirror images, left and right
    /// exchanged. Upside down the light network is worse: light mostly comes from above.
    pub fn mirrors_lights(self) -> bool {
        self != Self::Fast
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_settings() {
        for quality in Quality::ALL {
            let json = serde_json::to_value(quality).unwrap();
            assert_eq!(json, quality.name());
        }
    }
}
