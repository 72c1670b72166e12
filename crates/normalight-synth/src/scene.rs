//! An object under lamps, rendered once, from which many samples are taken.
mod crops;
mod framing;
mod photographs;
mod points;
mod stored;
mod symmetry;
mod transport;

pub use photographs::Labelled;
pub(crate) use points::Points;

use crate::camera::{Camera, Visible};
use crate::lighting::{Lamp, lamps, tinted};
use crate::materials::{Material, Measured, Surfaces};
use crate::random::{Random, Stream};
use crate::recipe::SceneRecipe;
use crate::sample::Sample;
use crate::shapes::{Library, Object, Overlay, View, object};
use crops::Crops;
use framing::frame;
use symmetry::Symmetry;
use transport::Transport;

/// Least share of a crop that shows the object.
const MIN_COVER: f32 = 0.4;
/// Scenes are drawn larger by this factor until crops can show enough of slender objects.
const NEARER: f32 = 1.35;
/// Objects drawn until one is seen.
const MOST_ATTEMPTS: usize = 16;
/// Up to this side scenes are drawn larger for that.
const LARGEST_SIDE: usize = 640;

/// What the drawing of a scene starts from.
pub(crate) struct SceneContext<'a> {
    pub(crate) recipe: &'a SceneRecipe,
    pub(crate) meshes: &'a Library,
    pub(crate) measured: &'a [Measured],
    pub(crate) seed: u64,
}

/// An object with the light of each lamp that reaches the camera, before any camera.
///
/// Rendering is the costly part; [`Scene::whole`] and [`Scene::crop`] take photographs of it.
pub struct Scene {
    seed: u64,
    recipe: SceneRecipe,
    view: View,
    crops: Option<Crops>,
    /// Number of the point at every pixel.
    ///
    /// `[height, width]`
    numbers: Vec<u32>,
    light: SceneLight,
    /// Whether the view's depth is that of the object.
    depth_known: bool,
}

/// The light that reaches the camera from the visible points of a scene.
struct SceneLight {
    lamps: Vec<Lamp>,
    /// At lamps of intensity 1.
    ///
    /// `[lamps][3][points]`
    radiance: Vec<[Vec<f32>; 3]>,
    /// What is the same in all images.
    ///
    /// `[3][points]`
    ambient: Option<[Vec<f32>; 3]>,
}

/// Which square of a scene becomes a picture, and how it is turned.
struct Crop {
    top: usize,
    left: usize,
    size: usize,
    symmetry: Symmetry,
}

impl Scene {
    /// The whole object in a square of `side` pixels.
    pub(crate) fn of_whole(context: &SceneContext, lamps: usize, side: usize) -> Self {
        let random = Random::new(context.seed, Stream::Framing);
        let (object, view) = Self::draw(context, &random, side);
        Self::render(context, &object, view, None, lamps)
    }

    /// An object large enough to cut crops of `size` pixels from.
    pub(crate) fn for_crops(context: &SceneContext, lamps: usize, size: usize) -> Self {
        let [low, high] = context.recipe.shapes.crop_object_pixels;
        let mut random = Random::new(context.seed, Stream::Framing);
        let mut side = (random.log_range(low, high) as usize).max(size);
        let largest = LARGEST_SIDE.max(size);
        let (object, mut view) = Self::draw(context, &random, side);
        loop {
            let crops = Crops::new(&view, size);
            if crops.best_cover() >= MIN_COVER || side >= largest {
                return Self::render(context, &object, view, Some(crops), lamps);
            }
            side = ((side as f32 * NEARER) as usize).min(largest);
            view = frame(&object, &context.recipe.shapes, &mut random.clone(), side);
        }
    }

    /// An object of which something is seen: a flat mesh may stand edge-on, then another one is drawn.
    fn draw<'a>(context: &SceneContext<'a>, framing: &Random, side: usize) -> (Object<'a>, View) {
        let shapes = &context.recipe.shapes;
        let mut random = Random::new(context.seed, Stream::Shape);
        let mut attempts = 0;
        loop {
            let object = object(shapes, context.meshes, &mut random);
            let view = frame(&object, shapes, &mut framing.clone(), side);
            attempts += 1;
            let seen = (0..view.depth.len()).any(|pixel| view.is_inside(pixel));
            if seen || attempts == MOST_ATTEMPTS {
                return (object, view);
            }
        }
    }

    fn render(
        context: &SceneContext,
        object: &Object,
        mut view: View,
        crops: Option<Crops>,
        lamp_count: usize,
    ) -> Self {
        let recipe = context.recipe;
        let mut random = Random::new(context.seed, Stream::Overlay);
        let is_mesh = matches!(object, Object::Mesh(_));
        let overlay = Overlay::draw(&recipe.shapes, &mut random, is_mesh, view.window.pitch);
        let grooves = overlay.apply(&mut view);
        let points = Points::new(&view).with_grooves(&grooves);
        let mut random = Random::new(context.seed, Stream::Material);
        let material = Material::draw(&recipe.materials, context.measured, &mut random);
        let surfaces = Surfaces::new(&material, &points.places, &points.normals);
        let transport = Transport::draw(&recipe.transport, &mut random);
        let mut random = Random::new(context.seed, Stream::Lights);
        let lamps = lamps(&recipe.lights, &mut random, lamp_count, object.reach());
        let light = SceneLight {
            radiance: transport.light(&view, &points, &surfaces, &lamps),
            ambient: transport.ambient(&points, &surfaces),
            lamps,
        };
        Self::new(context.seed, recipe, view, crops, light)
    }

    fn new(
        seed: u64,
        recipe: &SceneRecipe,
        view: View,
        crops: Option<Crops>,
        light: SceneLight,
    ) -> Self {
        let mut numbers = vec![u32::MAX; view.depth.len()];
        let visible = (0..view.depth.len()).filter(|&pixel| view.is_inside(pixel));
        for (number, pixel) in visible.enumerate() {
            numbers[pixel] = number as u32;
        }
        Self {
            seed,
            recipe: recipe.clone(),
            view,
            crops,
            numbers,
            light,
            depth_known: true,
        }
    }

    /// Number of lamps it was rendered with.
    pub fn lamps(&self) -> usize {
        self.light.lamps.len()
    }

    /// The same object under the same lamps for other samples: `seed` decides the order of the lamps,
    /// crops, brightness and cameras anew.
    pub fn reseeded(mut self, seed: u64) -> Self {
        let count = self.light.lamps.len();
        let order = Random::new(seed, Stream::Lights).some_of(count, count);
        self.light.lamps = order.iter().map(|&lamp| self.light.lamps[lamp]).collect();
        let radiance = order
            .iter()
            .map(|&l| std::mem::take(&mut self.light.radiance[l]));
        self.light.radiance = radiance.collect();
        self.seed = seed;
        self
    }

    /// Photographs of the whole picture under the first `images` lamps (at most those rendered).
    pub fn whole(&self, images: usize) -> Sample {
        let mut random = Random::new(self.seed, Stream::Camera);
        let chosen: Vec<usize> = (0..images.min(self.light.lamps.len())).collect();
        let side = self.view.window.width;
        let crop = Crop {
            top: 0,
            left: 0,
            size: side,
            symmetry: Symmetry::NONE,
        };
        self.photograph(&chosen, &crop, &mut random)
    }

    /// Photographs of crop number `part`: a window, lamps, brightness, exposure and noise of its own.
    ///
    /// # Panics
    /// The scene was not made for crops.
    pub fn crop(&self, part: usize, images: usize) -> Sample {
        let crops = self.crops.as_ref().expect("a scene made for crops");
        let seed = self.seed ^ (part as u64 + 1).wrapping_mul(0xa076_1d64_78bd_642f);
        let mut random = Random::new(seed, Stream::Crop);
        let (top, left) = crops.draw(&mut random, MIN_COVER);
        let crop = Crop {
            top,
            left,
            size: crops.size(),
            symmetry: Symmetry::draw(&mut random),
        };
        let chosen = random.some_of(self.light.lamps.len(), images);
        self.photograph(&chosen, &crop, &mut random)
    }

    fn photograph(&self, chosen: &[usize], crop: &Crop, random: &mut Random) -> Sample {
        let Crop {
            top,
            left,
            size,
            symmetry,
        } = *crop;
        let lamps: Vec<Lamp> = chosen.iter().map(|&lamp| self.light.lamps[lamp]).collect();
        let mut lights = tinted(&self.recipe.lights, random, &lamps);
        let mut sample = Sample::empty(size, chosen.len());
        // The visible pixels of the crop, in the order of the finished picture.
        let mut seen: Vec<(u32, u32)> = Vec::new();
        for row in 0..size {
            for column in 0..size {
                let from = (top + row) * self.view.window.width + left + column;
                if self.numbers[from] == u32::MAX {
                    continue;
                }
                let (row, column) = symmetry.pixel(row, column, size);
                let pixel = row * size + column;
                sample.mask[pixel] = true;
                sample.normals[pixel] = symmetry.vector(self.view.normals[from]);
                if self.depth_known {
                    sample.depth[pixel] = self.view.depth[from] / self.view.window.pitch;
                }
                seen.push((pixel as u32, self.numbers[from]));
            }
        }
        seen.sort_unstable();
        let pixels: Vec<u32> = seen.iter().map(|&(pixel, _)| pixel).collect();
        let numbers: Vec<u32> = seen.iter().map(|&(_, number)| number).collect();
        let mut light = Vec::with_capacity(chosen.len() * 3 * pixels.len());
        for (&lamp, tint) in chosen.iter().zip(&lights) {
            for channel in symmetry.channels {
                let plane = &self.light.radiance[lamp][channel];
                let intensity = tint.intensity[channel];
                match &self.light.ambient {
                    None => light.extend(numbers.iter().map(|&n| plane[n as usize] * intensity)),
                    Some(ambient) => light.extend(
                        numbers
                            .iter()
                            .map(|&n| plane[n as usize] * intensity + ambient[channel][n as usize]),
                    ),
                }
            }
        }
        for tint in &mut lights {
            tint.direction = symmetry.vector(tint.direction);
            tint.intensity = symmetry.channels.map(|channel| tint.intensity[channel]);
        }
        self.develop(&mut light, &pixels, &mut sample, random);
        sample.lights = lights;
        sample.lamps = chosen.to_vec();
        sample.axes = symmetry.axes();
        sample
    }

    /// From light at the visible pixels to the sample's images.
    fn develop(&self, light: &mut [f32], pixels: &[u32], sample: &mut Sample, random: &mut Random) {
        if pixels.is_empty() {
            return;
        }
        let camera = Camera::draw(&self.recipe.camera, random);
        let (mut sum, mut largest) = (0.0f32, 0.0f32);
        for plane in light.chunks_exact(pixels.len()) {
            let mut plane_sum = 0.0;
            for &value in plane {
                plane_sum += value;
                largest = if value > largest { value } else { largest };
            }
            sum += plane_sum / pixels.len() as f32;
        }
        let planes = light.len() / pixels.len();
        let gain = camera.gain(sum / planes as f32, largest);
        let (size, area) = (sample.size, sample.size * sample.size);
        let visible = Visible { size, pixels };
        let images = sample.images.chunks_exact_mut(3 * area);
        for (light, image) in light.chunks_exact_mut(3 * pixels.len()).zip(images) {
            camera.take(light, &visible, gain, random);
            let planes = light.chunks_exact(pixels.len());
            for (plane, values) in image.chunks_exact_mut(area).zip(planes) {
                for (&pixel, &value) in pixels.iter().zip(values) {
                    plane[pixel as usize] = value;
                }
            }
        }
    }
}
