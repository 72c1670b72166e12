use crate::ModelError;
use serde::{Deserialize, Serialize};

/// The cells of a network: chosen, or open to a search. Files leave open ones out.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(
    from = "Option<G>",
    into = "Option<G>",
    bound(
        serialize = "G: Serialize + Clone",
        deserialize = "G: Deserialize<'de>"
    )
)]
pub enum CellChoice<G> {
    /// These.
    Chosen(G),
    /// Yet to be chosen.
    #[default]
    Open,
}

impl<G> CellChoice<G> {
    /// The cells, where they are chosen.
    pub fn chosen(&self) -> Option<&G> {
        match self {
            Self::Chosen(genotype) => Some(genotype),
            Self::Open => None,
        }
    }

    /// Whether they are yet to be chosen.
    pub fn is_open(&self) -> bool {
        self.chosen().is_none()
    }

    /// The cells, to build a network of.
    ///
    /// # Errors
    /// [`ModelError::Architecture`] when they are open.
    pub fn required(&self) -> Result<&G, ModelError> {
        self.chosen().ok_or_else(|| ModelError::Architecture {
            what: "genotype".into(),
            found: "none".into(),
            expected: "the cells of the network".into(),
        })
    }
}

impl<G> From<G> for CellChoice<G> {
    fn from(genotype: G) -> Self {
        Self::Chosen(genotype)
    }
}

impl<G> From<Option<G>> for CellChoice<G> {
    fn from(genotype: Option<G>) -> Self {
        genotype.map_or(Self::Open, Self::Chosen)
    }
}

impl<G> From<CellChoice<G>> for Option<G> {
    fn from(choice: CellChoice<G>) -> Self {
        match choice {
            CellChoice::Chosen(genotype) => Some(genotype),
            CellChoice::Open => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        CellChoice, CellNormal, NormalArchitecture, NormalBody, NormalNetwork, SearchSpace,
        Upsampling, normal_cost, paper_genotypes,
    };
    use burn::tensor::Device;

    fn architecture(genotype: CellChoice<crate::NormalGenotype>) -> NormalArchitecture {
        NormalArchitecture {
            mask_channel: false,
            body: NormalBody::Cells(CellNormal {
                width: 4,
                stem_strides: [1, 2],
                reductions: 1,
                upsampling: Upsampling::Nearest,
                fused_convolutions: 1,
                genotype,
            }),
        }
    }

    #[test]
    fn open_cells_are_left_out_of_files_and_can_only_be_searched() {
        let chosen = architecture(paper_genotypes().normal.into());
        let open = architecture(CellChoice::Open);
        for (architecture, holds) in [(&chosen, true), (&open, false)] {
            let json = serde_json::to_string(architecture).unwrap();
            assert_eq!(json.contains("genotype"), holds);
            let back: NormalArchitecture = serde_json::from_str(&json).unwrap();
            assert_eq!(back, *architecture);
            assert!(architecture.validate().is_ok());
        }
        let device = Device::flex();
        assert!(NormalNetwork::new(&chosen, false, &device).is_ok());
        let refused = NormalNetwork::new(&open, false, &device).unwrap_err();
        assert!(refused.to_string().contains("genotype"), "{refused}");
        assert!(NormalNetwork::relaxed(&open, &SearchSpace::default(), &device).is_ok());
        assert!(normal_cost(&open, 64).parameters < normal_cost(&chosen, 64).parameters);
    }
}
