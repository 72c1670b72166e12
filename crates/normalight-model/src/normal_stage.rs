mod tiles;

use crate::helpers::{Helpers, NoHelpers, Parcel, packed};
use crate::light_stage::read_back;
use crate::observer::{Observer, PipelineStage, report};
use crate::{FusedFeatures, LoadedNormalNetwork, ModelError, NormalNetwork, normal_cost};
use burn::tensor::{Tensor, TensorData};
use normalight_core::{CalibratedStack, Mask, NormalMap, Rect, Symmetry, Vec3, spread_order};
use tiles::{Tile, TileView, tiles};

/// Most images that go through the network together, and most pixels of all of them: bounds the memory, and how long nothing
/// else is heard, whatever the size of the stack.
const BATCH: usize = 8;
const BATCH_PIXELS: usize = 4 * 320 * 320;

/// Images, about, whose features meet in one maximum. Trainings show a network at most some twenty images a
/// sample; the maximum over a hundred lies beyond what it has seen, and one odd image decides it.
const GROUP: usize = 24;

/// Normals, and how far apart those are that they are means of.
#[derive(Debug, Clone, PartialEq)]
pub struct AveragedNormals {
    /// Unit normals, zero outside the mask.
    pub normals: NormalMap,
    /// Root mean square angle in degrees between a pixel's normal in one view and group of images and their mean, one a
    /// pixel, rows from the top, zero outside the mask. `None` where there is only one.
    pub spread: Option<Vec<f32>>,
}

impl LoadedNormalNetwork {
    /// Estimates the normals of a stack under known lights, tile by tile, as [`NormalInput`](crate::NormalInput) encodes it.
    ///
    /// The network looks at the photographs in each of the `views` (one at least), and the normals, turned back, are
    /// averaged: what it errs differently in each view goes. One view costs as much as the next. More than 35 images are
    /// dealt into groups of about 24, each with normals of its own, which are averaged as well.
    ///
    /// # Errors
    /// [`ModelError::Cancelled`] or [`ModelError::Device`].
    pub async fn estimate(
        &self,
        calibrated: CalibratedStack<'_>,
        views: &[Symmetry],
        stage: PipelineStage,
        observer: &mut impl Observer,
    ) -> Result<AveragedNormals, ModelError> {
        let alone = self.helped_by(&NoHelpers);
        alone.estimate(calibrated, views, stage, observer).await
    }

    /// The same network with others who help.
    pub fn helped_by<'a, H: Helpers>(&'a self, helpers: &'a H) -> Helped<'a, H> {
        Helped {
            loaded: self,
            helpers,
        }
    }

    /// Multiply-adds of an estimate of the object in a mask, what is computed twice where tiles overlap included.
    pub(crate) fn multiply_adds(&self, images: usize, mask: &Mask, views: usize) -> u64 {
        let groups: Vec<usize> = groups(images).iter().map(Vec::len).collect();
        let of_tile = |kept: &Rect| -> u64 {
            let seen = kept.grown(self.architecture.overlap(), mask.width(), mask.height());
            let padded = |side: usize| side.next_multiple_of(NormalNetwork::ALIGNMENT);
            let cost = normal_cost(&self.architecture, padded(seen.width) * padded(seen.height));
            groups.iter().map(|&group| cost.multiply_adds(group)).sum()
        };
        tiles(mask).iter().map(of_tile).sum::<u64>() * views as u64
    }
}

/// A normal network with others who compute features of a part of the images.
#[derive(Debug, Clone, Copy)]
pub struct Helped<'a, H> {
    loaded: &'a LoadedNormalNetwork,
    helpers: &'a H,
}

impl<H: Helpers> Helped<'_, H> {
    /// What [`LoadedNormalNetwork::estimate`] does.
    ///
    /// # Errors
    /// The same.
    pub async fn estimate(
        &self,
        calibrated: CalibratedStack<'_>,
        views: &[Symmetry],
        stage: PipelineStage,
        observer: &mut impl Observer,
    ) -> Result<AveragedNormals, ModelError> {
        let network = &self.loaded.network;
        let (stack, mask) = (calibrated.stack(), calibrated.mask());
        let (width, height) = (stack.width(), stack.height());
        let mut normals = vec![Vec3::ZERO; width * height];
        let tiles = tiles(mask);
        let groups = groups(stack.len());
        let passes = network.passes();
        let steps = (tiles.len() * views.len() * stack.len() * passes) as f32;
        let mut done = 0;
        for &kept in &tiles {
            let tile = Tile::new(calibrated, kept, &self.loaded.architecture);
            for &symmetry in views {
                let view = TileView::new(&tile, symmetry);
                for group in &groups {
                    let mut earlier = Earlier::default();
                    for pass in 1..=passes {
                        let mut fused: Option<FusedFeatures> = None;
                        for images in rounds(group, view.pixels(), self.helpers.count()) {
                            report(observer, stage, done as f32 / steps).await?;
                            done += images.iter().map(|part| part.len()).sum::<usize>();
                            let more = self.fuse(&view, &images, &earlier).await;
                            fused = Some(match fused {
                                Some(before) => before.and(more),
                                None => more,
                            });
                        }
                        let Some(fused) = fused else { continue };
                        if pass < passes {
                            earlier.keep(fused, self.helpers.count() > 0).await?;
                        } else {
                            let values = read_back(network.regress(fused)).await?;
                            view.add(&values, &mut normals);
                        }
                    }
                }
            }
        }
        let votes = views.len() * groups.len();
        let spread = (votes > 1).then(|| spread(&normals, votes));
        if votes > 1 {
            for (normal, &inside) in normals.iter_mut().zip(mask.inside()) {
                if inside {
                    *normal = normal.normalize_or(Vec3::Z);
                }
            }
        }
        report(observer, stage, 1.0).await?;
        Ok(AveragedNormals {
            normals: NormalMap::new(width, height, normals),
            spread,
        })
    }

    /// Features of a round's images: the first part's are computed here, the others' by a helper each.
    async fn fuse(
        &self,
        view: &TileView<'_>,
        round: &[&[usize]],
        earlier: &Earlier,
    ) -> FusedFeatures {
        let here = |images: &[usize]| {
            let (values, shape) = view.batch(images);
            let input = Tensor::from_data(TensorData::new(values, shape), &self.loaded.device);
            self.loaded.network.fuse_after(input, 1, &earlier.features)
        };
        let [own, others @ ..] = round else {
            unreachable!("a round has a part at least");
        };
        let mut working = Vec::with_capacity(others.len());
        for (helper, images) in others.iter().enumerate() {
            let (values, shape) = view.batch(images);
            let work = Parcel::work(values, shape, &earlier.parcels);
            working.push(self.helpers.features(helper, work));
        }
        let mut fused = here(own);
        for (images, answer) in others.iter().zip(working) {
            let found = answer
                .await
                .and_then(|found| found.features(&self.loaded.device));
            fused = fused.and(found.unwrap_or_else(|| here(images)));
        }
        fused
    }
}

/// What earlier passes kept of all images.
#[derive(Default)]
struct Earlier {
    features: Vec<FusedFeatures>,
    /// The same for helpers, where there are any.
    parcels: Vec<Parcel>,
}

impl Earlier {
    async fn keep(&mut self, features: FusedFeatures, for_helpers: bool) -> Result<(), ModelError> {
        if for_helpers {
            self.parcels.push(packed(features.clone()).await?);
        }
        self.features.push(features);
        Ok(())
    }
}

/// Deals images into parts that go through the network together, rounds of as many parts as there are to compute them.
fn rounds(images: &[usize], pixels: usize, helpers: usize) -> Vec<Vec<&[usize]>> {
    let workers = 1 + helpers;
    let most = (BATCH_PIXELS / pixels.max(1)).clamp(1, BATCH);
    let parts = images.len().div_ceil(most).next_multiple_of(workers);
    let parts = parts.min(images.len());
    let start = |part: usize| part * images.len() / parts.max(1);
    let parts: Vec<&[usize]> = (0..parts)
        .map(|part| &images[start(part)..start(part + 1)])
        .collect();
    parts.chunks(workers).map(<[_]>::to_vec).collect()
}

/// Root mean square angle in degrees between unit vectors and their mean, of the sums of `votes` of them each; as an estimate
/// of what more of them would have.
fn spread(sums: &[Vec3], votes: usize) -> Vec<f32> {
    let votes = votes as f32;
    let spread = |sum: &Vec3| {
        let apart = (1.0 - sum.length() / votes).max(0.0);
        // For small angles a vector at angle a adds cos a = 1 - a^2 / 2 to the sum.
        (2.0 * apart * votes / (votes - 1.0)).sqrt().to_degrees()
    };
    let inside = |sum: &Vec3| if *sum == Vec3::ZERO { 0.0 } else { spread(sum) };
    sums.iter().map(inside).collect()
}

/// Deals images into groups of about [`GROUP`], each with lights from all sides.
fn groups(images: usize) -> Vec<Vec<usize>> {
    let count = ((images + GROUP / 2) / GROUP).max(1);
    let order = spread_order(images);
    (0..count)
        .map(|group| {
            let mut group = order[group * images / count..(group + 1) * images / count].to_vec();
            group.sort_unstable();
            group
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_is_the_angle_between_votes() {
        // Two votes, each `a` from their mean: with one degree of freedom less, a times the root of two.
        let at =
            |degrees: f32| Vec3::new(degrees.to_radians().sin(), 0.0, degrees.to_radians().cos());
        let found = spread(&[at(-6.0) + at(6.0), at(3.0) + at(3.0), Vec3::ZERO], 2);
        assert!((found[0] - 6.0 * 2f32.sqrt()).abs() < 0.02, "{found:?}");
        assert!(found[1] < 0.05 && found[2] == 0.0);
    }

    #[test]
    fn rounds_hold_every_image_once_in_parts_for_all_who_compute() {
        for (images, pixels, helpers, expected) in [
            (16, 192 * 192, 0, vec![vec![8], vec![8]]),
            (16, 192 * 192, 1, vec![vec![8, 8]]),
            (12, 192 * 192, 2, vec![vec![4, 4, 4]]),
            (9, 192 * 192, 1, vec![vec![4, 5]]),
            (24, 192 * 192, 1, vec![vec![6, 6], vec![6, 6]]),
            (2, 192 * 192, 3, vec![vec![1, 1]]),
            (5, 576 * 576, 1, vec![vec![1, 1], vec![1, 1], vec![1]]),
        ] {
            let numbers: Vec<usize> = (0..images).collect();
            let rounds = rounds(&numbers, pixels, helpers);
            assert_eq!(rounds.concat().concat(), numbers);
            let lengths = |round: &Vec<&[usize]>| -> Vec<usize> {
                round.iter().map(|part| part.len()).collect()
            };
            assert_eq!(rounds.iter().map(lengths).collect::<Vec<_>>(), expected);
        }
    }

    #[test]
    fn groups_hold_every_image_once() {
        for images in 1..200 {
            let groups = groups(images);
            let mut dealt = groups.concat();
            dealt.sort_unstable();
            assert_eq!(dealt, (0..images).collect::<Vec<_>>());
            for group in &groups {
                assert!(
                    group.len() <= 36,
                    "{images} images: group of {}",
                    group.len()
                );
                assert!(
                    images < 36 || group.len() >= 18,
                    "{images}: {}",
                    group.len()
                );
            }
        }
    }
}
