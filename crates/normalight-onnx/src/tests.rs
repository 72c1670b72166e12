//! Every architecture becomes a model with all of its tensors; that runtimes get the same numbers from it, the package's tests
//! see (`web/test/onnx.test.js`).
use crate::to_onnx;
use burn::tensor::Device;
use normalight_model::{
    CellLight, CellNormal, LayerKind, LightArchitecture, LightBody, LightNetwork, Meeting,
    NormalArchitecture, NormalBody, NormalNetwork, PixelStage, PlainNormal, Stage, StagedLight,
    StagedNormal, Upsampling, Weights, paper_genotypes,
};
use std::collections::BTreeMap;

fn light(body: LightBody) -> Weights {
    let architecture = LightArchitecture {
        body,
        ..LightArchitecture::plain()
    };
    let network = LightNetwork::new(&architecture, false, &Device::flex()).unwrap();
    let bytes = Weights::light_bytes(&architecture, &network, &BTreeMap::new()).unwrap();
    Weights::from_bytes("light", &bytes).unwrap()
}

fn normal(body: NormalBody) -> Weights {
    let architecture = NormalArchitecture {
        mask_channel: true,
        body,
    };
    let network = NormalNetwork::new(&architecture, false, &Device::flex()).unwrap();
    let bytes = Weights::normal_bytes(&architecture, &network, &BTreeMap::new()).unwrap();
    Weights::from_bytes("normal", &bytes).unwrap()
}

fn stage(width: usize, layers: usize, kind: LayerKind, normalised: bool) -> Stage {
    Stage {
        width,
        layers,
        kind,
        residual: layers > 1,
        normalised,
    }
}

fn staged_light() -> LightBody {
    LightBody::Staged(StagedLight {
        features: vec![
            stage(4, 2, LayerKind::Separable3, true),
            stage(6, 1, LayerKind::Separable5, false),
        ],
        classifier: vec![
            stage(4, 2, LayerKind::Pointwise, false),
            stage(4, 1, LayerKind::Convolution3, true),
        ],
        hidden: 8,
    })
}

fn staged_normal() -> NormalBody {
    NormalBody::Staged(StagedNormal {
        down: vec![
            stage(4, 2, LayerKind::Separable3, false),
            stage(6, 1, LayerKind::Separable5, true),
            stage(6, 1, LayerKind::Convolution3, false),
        ],
        up: vec![stage(5, 2, LayerKind::Transposed4, false)],
        meeting: Meeting::MaxMean,
        exchanges: 2,
        fused: vec![
            stage(4, 2, LayerKind::Pointwise, true),
            stage(4, 1, LayerKind::Separable3, false),
        ],
        pixels: Some(PixelStage {
            width: 3,
            layers: 3,
        }),
    })
}

fn cell_normal(upsampling: Upsampling, stem: usize, reductions: usize) -> NormalBody {
    NormalBody::Cells(CellNormal {
        width: 2,
        stem_strides: [1, stem],
        reductions,
        upsampling,
        fused_convolutions: stem,
        genotype: paper_genotypes().normal.into(),
    })
}

#[test]
fn every_architecture_becomes_a_model_with_all_of_its_tensors() {
    let mut pixels = PlainNormal::new([4, 6, 8], 4);
    (pixels.residuals, pixels.pixel_branch) = (2, 3);
    let cell_light = LightBody::Cells(CellLight {
        width: 2,
        stem_strides: [1, 2],
        reductions: 2,
        hidden: 8,
        genotype: paper_genotypes().light.into(),
    });
    let networks = [
        light(LightArchitecture::plain().body),
        light(cell_light),
        light(staged_light()),
        normal(NormalBody::Plain(pixels)),
        normal(cell_normal(Upsampling::Transposed, 1, 1)),
        normal(cell_normal(Upsampling::Nearest, 1, 2)),
        normal(cell_normal(Upsampling::Nearest, 2, 2)),
        normal(staged_normal()),
    ];
    for weights in networks {
        let model = to_onnx(&weights).unwrap_or_else(|error| panic!("{error}"));
        let holds = |text: &str| {
            let mut windows = model.windows(text.len());
            windows.any(|window| window == text.as_bytes())
        };
        assert!(holds(weights.hash()) && holds("\"kind\":"));
    }
}
