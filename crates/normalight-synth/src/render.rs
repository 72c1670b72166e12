use crate::bounce::Bounces;
use crate::brdf::{Lamp, Surface};
use crate::camera::Camera;
use crate::framing::{Framed, Framing, frame};
use crate::lamps::lamps;
use crate::material::Paint;
use crate::noise::Lattice;
use crate::objects::object;
use crate::random::{Random, Stream};
use crate::recipe::{SceneRecipe, TransportRecipe};
use crate::sample::Sample;
use crate::shadow::Shadows;
use crate::view::Detail;
use glam::Vec3;
use normalight_core::Light;

/// Draws and renders sample `seed` of a recipe: always the same bits for the same arguments, on any
/// machine and thread. The shape, materials and lights' layout do not depend on `images`.
///
/// The recipe must have passed [`SceneRecipe::validate`]; others give meaningless samples.
///
/// # Panics
/// `images` or `size` is zero.
pub fn render_sample(
    recipe: &SceneRecipe,
    seed: u64,
    images: usize,
    size: usize,
    framing: Framing,
) -> Sample {
    assert!(images > 0 && size > 0, "a sample needs images and pixels");
    let shape = object(&recipe.shapes, &mut Random::new(seed, Stream::Shape));
    let mut random = Random::new(seed, Stream::Material);
    let paint = Paint::draw(&recipe.materials, &mut random);
    let transport = Transport::draw(&recipe.transport, &mut random);
    let mut random = Random::new(seed, Stream::Framing);
    let around = transport.around();
    let framed = frame(&shape, &recipe.shapes, &mut random, size, framing, around);
    let lights = lamps(
        &recipe.lights,
        &mut Random::new(seed, Stream::Lights),
        images,
    );
    let points = Points::new(&framed, &paint);

    let area = size * size;
    let mut planes = vec![0.0; images * 3 * area];
    shade(
        &mut planes,
        area,
        &framed,
        &points,
        &lights,
        &transport,
        &paint,
    );
    let mut random = Random::new(seed, Stream::Camera);
    let camera = Camera::draw(&recipe.camera, &mut random);
    let gain = exposure(&camera, &planes, area, &points.pixels);
    for plane in planes.chunks_exact_mut(area) {
        camera.take(plane, &points.pixels, gain, &mut random);
    }
    Sample {
        size,
        images: planes,
        mask: (0..area)
            .map(|pixel| framed.view.is_inside(pixel))
            .collect(),
        normals: framed.view.normals,
        lights,
    }
}

/// Which light paths a scene has.
struct Transport {
    shadows: bool,
    bounces: bool,
    ambient: f32,
}

impl Transport {
    fn draw(recipe: &TransportRecipe, random: &mut Random) -> Self {
        Self {
            shadows: random.chance(recipe.cast_shadow_share),
            bounces: random.chance(recipe.bounce_share),
            ambient: if random.chance(recipe.ambient_share) {
                recipe.ambient * random.unit()
            } else {
                0.0
            },
        }
    }

    /// What has to be known of the object outside a crop.
    fn around(&self) -> Option<Detail> {
        if self.bounces {
            Some(Detail::DepthAndNormals)
        } else {
            self.shadows.then_some(Detail::Depth)
        }
    }
}

/// The visible points, in the order of their pixels.
struct Points {
    pixels: Vec<usize>,
    places: Vec<Vec3>,
    normals: Vec<Vec3>,
    surfaces: Vec<Surface>,
}

impl Points {
    fn new(framed: &Framed, paint: &Paint) -> Self {
        let (view, window) = (&framed.view, framed.view.window);
        let pixels: Vec<usize> = (0..view.depth.len())
            .filter(|&pixel| view.is_inside(pixel))
            .collect();
        let places: Vec<Vec3> = pixels
            .iter()
            .map(|&pixel| {
                let (x, y) = (
                    window.x(pixel % window.width),
                    window.y(pixel / window.width),
                );
                Vec3::new(x, y, view.depth[pixel])
            })
            .collect();
        Self {
            normals: pixels.iter().map(|&pixel| view.normals[pixel]).collect(),
            surfaces: places
                .iter()
                .map(|&place| paint.at(Lattice::shared(), place))
                .collect(),
            pixels,
            places,
        }
    }
}

/// Fills the planes (`[images, 3, area]`) with the light that reaches the camera.
fn shade(
    planes: &mut [f32],
    area: usize,
    framed: &Framed,
    points: &Points,
    lights: &[Light],
    transport: &Transport,
    paint: &Paint,
) {
    let shadows = transport
        .shadows
        .then(|| Shadows::new(&framed.view, framed.overview.as_ref()));
    for (image, light) in planes.chunks_exact_mut(3 * area).zip(lights) {
        let lamp = Lamp::new(light.direction);
        for (index, &pixel) in points.pixels.iter().enumerate() {
            let (surface, normal) = (&points.surfaces[index], points.normals[index]);
            let mut colour = lamp.shade(surface, normal);
            if let Some(shadows) = &shadows
                && colour != Vec3::ZERO
            {
                colour *= shadows.lit(points.places[index], normal, light.direction);
            }
            // The room is lit by the lamp too; what faces the camera's side gets more of it.
            colour += surface.albedo * (transport.ambient * (0.5 + 0.5 * normal.z));
            put(image, area, pixel, colour * light.intensity[0]);
        }
    }
    if transport.bounces {
        add_bounces(planes, area, framed, points, lights, paint);
    }
}

fn add_bounces(
    planes: &mut [f32],
    area: usize,
    framed: &Framed,
    points: &Points,
    lights: &[Light],
    paint: &Paint,
) {
    let whole = framed.overview.as_ref().unwrap_or(&framed.view);
    let bounces = Bounces::new(whole, lights, |point| paint.at(Lattice::shared(), point));
    let mut falling = vec![Vec3::ZERO; lights.len()];
    for (index, &pixel) in points.pixels.iter().enumerate() {
        falling.fill(Vec3::ZERO);
        bounces.gather(points.places[index], points.normals[index], &mut falling);
        let albedo = points.surfaces[index].albedo;
        for (image, &light) in planes.chunks_exact_mut(3 * area).zip(&falling) {
            put(image, area, pixel, albedo * light);
        }
    }
}

/// Adds a colour to one pixel of an image of three planes.
#[inline]
fn put(image: &mut [f32], area: usize, pixel: usize, colour: Vec3) {
    image[pixel] += colour.x;
    image[area + pixel] += colour.y;
    image[2 * area + pixel] += colour.z;
}

fn exposure(camera: &Camera, planes: &[f32], area: usize, pixels: &[usize]) -> f32 {
    let (mut sum, mut largest) = (0.0f32, 0.0f32);
    for plane in planes.chunks_exact(area) {
        let mut plane_sum = 0.0;
        for &pixel in pixels {
            plane_sum += plane[pixel];
            largest = largest.max(plane[pixel]);
        }
        sum += plane_sum;
    }
    let count = planes.len() / area * pixels.len().max(1);
    camera.gain(sum / count as f32, largest)
}
