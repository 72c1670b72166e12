//! Normals that others help with.
use crate::scene::{Scene, Untrained, furthest};
use normalight_model::{
    Helpers, LoadedNormalNetwork, Meeting, ModelError, NoopObserver, NormalArchitecture,
    NormalBody, Parcel, PixelStage, Quality, Stage, StagedNormal,
};
use std::cell::RefCell;

/// Helpers with networks of their own, the second of which fails.
struct Two {
    networks: [LoadedNormalNetwork; 2],
    /// Who was given work.
    asked: RefCell<Vec<usize>>,
}

impl Helpers for Two {
    fn count(&self) -> usize {
        2
    }

    fn features(&self, helper: usize, work: Parcel) -> impl Future<Output = Option<Parcel>> {
        self.asked.borrow_mut().push(helper);
        let found = pollster::block_on(self.networks[helper].features(&work)).ok();
        std::future::ready(found.filter(|_| helper == 0))
    }
}

#[test]
fn helpers_change_nothing_whether_they_fail_or_not() {
    let scene = Scene::new(24, 16, |x, y| x + y < 5);
    // Seven images in three parts.
    let scene = Scene {
        images: [
            vec![scene.images.clone(); 2].concat(),
            vec![scene.images[1].clone()],
        ]
        .concat(),
        lights: [
            vec![scene.lights.clone(); 2].concat(),
            vec![scene.lights[0]],
        ]
        .concat(),
        ..scene
    };
    let staged = StagedNormal {
        down: vec![Stage::plain(8, 1), Stage::plain(12, 1)],
        up: Vec::new(),
        meeting: Meeting::MaxMean,
        exchanges: 1,
        fused: vec![Stage::plain(12, 1), Stage::plain(8, 1)],
        pixels: Some(PixelStage {
            width: 8,
            layers: 1,
        }),
    };
    let [plain, staged] = [NormalArchitecture::plain().body, NormalBody::Staged(staged)];
    for (body, passes) in [(plain, 1), (staged, 2)] {
        let untrained = Untrained::of(body);
        let helpers = Two {
            networks: [0, 1].map(|_| untrained.loaded.clone()),
            asked: RefCell::default(),
        };
        let views = Quality::Fast.views();
        let alone = untrained.normals(&scene, views, &mut NoopObserver).unwrap();
        let helped = untrained
            .helped(&helpers, &scene, views, &mut NoopObserver)
            .unwrap();
        assert_eq!(helpers.asked.into_inner(), [0, 1].repeat(passes));
        assert!(
            furthest(&alone, &helped) < 1e-5,
            "{}",
            furthest(&alone, &helped)
        );
    }
}

#[test]
fn work_of_another_kind_is_refused() {
    let untrained = Untrained::new();
    for (shapes, count) in [
        (vec![1, 8, 8, 6], 384),
        (vec![1, 8, 9, 7], 504),
        (vec![1, 8, 8, 7], 447),
        (vec![1, 8, 8, 7, 1], 448),
        (vec![0, 8, 8, 7], 0),
        (vec![], 0),
    ] {
        let values = vec![0.0; count];
        let work = Parcel { shapes, values };
        let refused = pollster::block_on(untrained.loaded.features(&work));
        assert!(matches!(refused, Err(ModelError::Device(_))), "{work:?}");
    }
    let work = Parcel {
        shapes: vec![1, 8, 8, 7],
        values: vec![0.5; 448],
    };
    assert!(pollster::block_on(untrained.loaded.features(&work)).is_ok());
}
