use crate::cache::SceneCache;
use crate::{PublishedChoice, PublishedRecipe, TrainError, TrainRecipe};
use normalight_io::{PublishedEntry, PublishedSet, PublishedSplit};
use normalight_synth::{Framing, Labelled, Renderer, Sample, Scene, SceneRecipe, scrambled};

/// Numbers of validation objects start here, far from any training object.
const VALIDATION_NUMBERS: u64 = 1 << 40;
/// Numbers of the scenes of the second half of a search start here.
const SECOND_HALF_NUMBERS: u64 = 1 << 42;
/// Images of a validation object.
const VALIDATION_IMAGES: usize = 12;
/// The search of the paper: share of the set, and side of its pictures.
const SEARCH_SHARE: f64 = 0.1;
const SEARCH_SIDE: usize = 64;

/// Where samples come from.
pub enum Source {
    /// From a renderer, or from scenes that it made before.
    Rendered(Box<Rendered>),
    /// From photographs, or pictures that others rendered.
    Published(Box<Published>),
}

/// Scenes rendered when they are needed.
pub struct Rendered {
    renderer: Renderer,
    /// Of validation objects.
    validation: Renderer,
    cache: Option<SceneCache>,
    /// Added to the numbers of scenes.
    first: u64,
}

/// A published set and how it is divided.
pub struct Published {
    set: PublishedSet,
    split: PublishedSplit,
    part: PublishedChoice,
    /// How its photographs become samples.
    scene: SceneRecipe,
    /// Whether samples come from the split's validation part.
    second_half: bool,
}

impl Source {
    /// `framing`: what the samples will show.
    ///
    /// # Errors
    /// The files that the recipe names.
    pub fn open(recipe: &TrainRecipe, framing: Framing) -> Result<Self, TrainError> {
        let Some(published) = &recipe.published else {
            let renderer = Renderer::new(recipe.scene.clone())?;
            let cache = recipe.cache.as_ref();
            let cache = cache.map(|cache| SceneCache::open(cache, recipe, framing));
            return Ok(Self::Rendered(Box::new(Rendered {
                validation: renderer.validation()?,
                renderer,
                cache: cache.transpose()?,
                first: 0,
            })));
        };
        Ok(Self::Published(Box::new(Published::open(
            recipe, published, false,
        )?)))
    }

    /// Both halves of a search's data, which show no shape in common: other random shapes, every second mesh, the two
    /// parts of a published set's split.
    ///
    /// # Errors
    /// As of [`Self::open`]; a mesh alone.
    pub fn halves(recipe: &TrainRecipe) -> Result<[Self; 2], TrainError> {
        if let Some(published) = &recipe.published {
            let half = |second| Published::open(recipe, published, second);
            return Ok([half(false)?, half(true)?].map(|half| Self::Published(Box::new(half))));
        }
        let half = |renderer: Renderer, first| -> Result<Self, TrainError> {
            Ok(Self::Rendered(Box::new(Rendered {
                validation: renderer.validation()?,
                renderer,
                cache: None,
                first,
            })))
        };
        let [one, other] = Renderer::halves(recipe.scene.clone())?;
        Ok([half(one, 0)?, half(other, SECOND_HALF_NUMBERS)?])
    }

    /// Scene `number`, fit for samples of up to `images` images and of the recipe's size.
    pub fn scene(
        &self,
        recipe: &TrainRecipe,
        number: u64,
        images: usize,
        framing: Framing,
    ) -> Result<Scene, TrainError> {
        let size = recipe.size;
        match self {
            Self::Rendered(rendered) => {
                let (renderer, number) = (&rendered.renderer, rendered.first + number);
                match (&rendered.cache, framing) {
                    (Some(cache), _) => cache.scene(renderer, number, size, framing),
                    (None, Framing::WholeObject) => Ok(renderer.whole_scene(number, images, size)),
                    (None, Framing::Crop) => Ok(renderer.crop_scene(number, images, size)),
                }
            }
            Self::Published(published) => {
                let split = &published.split;
                let entries = if published.second_half {
                    &split.validation
                } else {
                    &split.train
                };
                let entry = &entries[(scrambled(number) >> 8) as usize % entries.len()];
                published.scene(entry, number, size, framing)
            }
        }
    }

    /// Whole unseen objects, for validation; of meshes that are not trained on where the recipe names such.
    pub fn validation_objects(
        &self,
        recipe: &TrainRecipe,
        pixels: usize,
    ) -> Result<Vec<Sample>, TrainError> {
        let count = recipe.validation_objects;
        let numbers = (0..count as u64).map(|k| VALIDATION_NUMBERS + k);
        match self {
            Self::Rendered(rendered) => Ok(numbers
                .map(|number| {
                    let whole = Framing::WholeObject;
                    rendered
                        .validation
                        .sample(number, VALIDATION_IMAGES, pixels, whole)
                })
                .collect()),
            Self::Published(published) => {
                let entries = published.split.validation.iter().cycle();
                let whole = Framing::WholeObject;
                numbers
                    .zip(entries)
                    .map(|(number, entry)| {
                        let scene = published.scene(entry, number, pixels, whole)?;
                        Ok(scene.whole(VALIDATION_IMAGES))
                    })
                    .collect()
            }
        }
    }
}

impl Published {
    fn open(
        recipe: &TrainRecipe,
        published: &PublishedRecipe,
        second_half: bool,
    ) -> Result<Self, TrainError> {
        let set = PublishedSet::open(&published.folder)?;
        let split = match published.part {
            PublishedChoice::Train => set.train_split(recipe.seed)?,
            PublishedChoice::Search => set.search_split(recipe.seed, SEARCH_SHARE)?,
        };
        Ok(Self {
            set,
            split,
            part: published.part,
            scene: recipe.scene.clone(),
            second_half,
        })
    }

    fn scene(
        &self,
        entry: &PublishedEntry,
        seed: u64,
        size: usize,
        framing: Framing,
    ) -> Result<Scene, TrainError> {
        let mut object = self.set.read(entry)?;
        if self.part == PublishedChoice::Search {
            object = object.resized(SEARCH_SIDE)?;
        }
        let crop = (framing == Framing::Crop).then_some(size);
        if framing == Framing::WholeObject && object.stack.width() > size {
            object = object.resized(size)?;
        }
        let labelled = Labelled {
            stack: &object.stack,
            mask: &object.mask,
            normals: &object.normals,
            lights: &object.lights,
        };
        Ok(Scene::from_photographs(&self.scene, seed, labelled, crop)?)
    }
}
