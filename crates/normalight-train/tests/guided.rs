//! Training of a light network that looks again.
mod common;

use burn::tensor::Device;
use common::*;
use normalight_model::{Architecture, LightArchitecture, LightBody, PlainLight, Weights};
use normalight_train::{RunState, TrainError, TrainRecipe};
use safetensors::SafeTensors;

/// A guided copy of the shipped network's layers; `guidance`: what its samples see.
fn recipe_with(guidance: &str) -> TrainRecipe {
    let text = format!("{LIGHT}steps = 6\nvalidate_every = 3\n[light.guidance]\n{guidance}");
    let mut recipe = recipe(&text);
    recipe.light.architecture.guided = true;
    recipe
}

#[test]
fn a_guided_run_resumes_bit_for_bit() {
    let recipe = recipe_with("predicted = 0.4\nperturbed = 0.3\n");
    let (straight, broken) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let all = whole(straight.path(), &recipe);
    assert_eq!(all.losses.len(), 6);
    assert!(all.losses.iter().all(|loss| loss.is_finite()));
    let first = run(broken.path(), &recipe, false, Some(3)).unwrap();
    assert_eq!(first.summary.state, RunState::Interrupted);
    let second = run(broken.path(), &recipe, true, None).unwrap();
    assert_eq!([first.losses, second.losses].concat(), all.losses);
    let (straight, broken) = (contents(straight.path()), contents(broken.path()));
    assert!(straight["weights.safetensors"] == broken["weights.safetensors"]);
    // Both looks are judged: the second decides, the first is a figure.
    let curves = String::from_utf8(straight["curves.csv"].clone()).unwrap();
    assert!(curves.contains("first_degrees"), "{curves}");
}

/// Weights of the first convolution, `[out, in, 3, 3]`, by input channel: whether any is not zero.
fn used(bytes: &[u8]) -> Vec<bool> {
    let file = SafeTensors::deserialize(bytes).unwrap();
    let (_, first) = file
        .iter()
        .find(|(name, _)| name.contains("features") && name.contains("convolutions.0.weight"))
        .unwrap();
    let [_, channels, height, width] = first.shape() else {
        panic!("{:?}", first.shape());
    };
    let mut used = vec![false; *channels];
    for (index, half) in first.data().chunks_exact(2).enumerate() {
        let channel = index / (height * width) % channels;
        // All bits but the sign of a half.
        used[channel] |= u16::from_le_bytes([half[0], half[1]]) & 0x7fff != 0;
    }
    used
}

#[test]
fn a_widened_start_learns_to_use_its_guidance() {
    let place = tempfile::tempdir().unwrap();
    let init = place.path().join("light.safetensors");
    std::fs::write(
        &init,
        include_bytes!("../../../models/default/light.safetensors"),
    )
    .unwrap();
    for (guidance, learns) in [
        ("predicted = 1.0\n", true),
        ("predicted = 0.0\nperturbed = 1.0\n", true),
        // Nothing is ever known.
        ("predicted = 0.0\n", false),
    ] {
        let mut recipe = recipe_with(guidance);
        recipe.init = Some(init.clone());
        let folder = tempfile::tempdir().unwrap();
        whole(folder.path(), &recipe);
        let bytes = &contents(folder.path())["weights.safetensors"];
        let weights = Weights::from_bytes("guided", bytes).unwrap();
        assert_eq!(
            *weights.architecture(),
            Architecture::Light(recipe.light.architecture.clone())
        );
        weights.light_network(&Device::flex()).unwrap();
        let [photograph, known] = [[true; 4], [learns; 4]];
        assert_eq!(used(bytes), [photograph, known].concat(), "{guidance}");
    }
}

/// A start is widened by guidance and by nothing else.
#[test]
fn other_starts_are_refused() {
    let place = tempfile::tempdir().unwrap();
    let init = place.path().join("light.safetensors");
    std::fs::write(
        &init,
        include_bytes!("../../../models/default/light.safetensors"),
    )
    .unwrap();
    let mut recipe = recipe_with("predicted = 0.5\n");
    recipe.init = Some(init);
    recipe.light.architecture = LightArchitecture {
        body: LightBody::Plain(PlainLight {
            widths: [16, 32, 64],
            hidden: 129,
        }),
        ..recipe.light.architecture
    };
    let error = run(&place.path().join("run"), &recipe, false, None).unwrap_err();
    assert!(matches!(error, TrainError::Init { .. }), "{error}");
}
