//! Masks told from photographs alone, on scenes in closed form: a ball or a bump before, on or over
//! backgrounds that make it hard, with cast shadows and noise.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
use normalight_core::{ImageStack, Mask, Samples, StackImage, Transfer, Vec3};

const WIDTH: usize = 200;
const HEIGHT: usize = 150;
/// Radius of the ball in pixels.
const RADIUS: f32 = 42.0;
/// Light that reaches shadows.
const AMBIENT: f32 = 0.05;

#[derive(Clone, Copy, PartialEq, Debug)]
enum Shape {
    Ball,
    /// A cap of the ball, whose rim lies on the background.
    Bump,
    /// No object, a flat background.
    Nothing,
    /// No object, waves all over the frame.
    Relief,
}

#[derive(Clone, Copy, Debug)]
struct Scene {
    shape: Shape,
    /// Reflected part of the light: of the object, of the background.
    albedo: [f32; 2],
    /// Contrast of what is printed on the background.
    print: f32,
    /// How far the background is turned from the camera's view, radians.
    pitch: f32,
    /// Distance of the lamps in pixels, if they are near.
    lamps: Option<f32>,
    /// Whether room light alone reaches the background.
    lit_by_room: bool,
    /// Pixels for each of the scene's.
    scale: usize,
}

const WALL: Scene = Scene {
    shape: Shape::Ball,
    albedo: [0.5, 0.5],
    print: 0.0,
    pitch: 0.0,
    lamps: None,
    lit_by_room: false,
    scale: 1,
};

/// A number in 0..1 that looks like chance.
fn chance(seed: usize) -> f32 {
    let mut bits = (seed as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ (bits >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    ((bits >> 40) as f32) / (1u32 << 24) as f32
}

impl Scene {
    /// The centre of the ball; the background passes through or below it.
    fn ball(&self) -> Vec3 {
        let depth = if self.shape == Shape::Bump {
            -0.6 * RADIUS
        } else {
            0.0
        };
        Vec3::new(6.0, -4.0, depth)
    }

    /// Place and normal of the background that is seen at `x`, `y`.
    fn background(&self, x: f32, y: f32) -> (Vec3, Vec3) {
        let (sine, cosine) = self.pitch.sin_cos();
        let normal = Vec3::new(0.0, sine, cosine);
        // A wall right behind the ball, or a table that it lies on.
        let below = match self.shape {
            Shape::Bump => 0.0,
            _ => RADIUS,
        };
        let depth = -(below + sine * (y - self.ball().y)) / cosine;
        let place = Vec3::new(x, y, depth);
        if self.shape == Shape::Relief {
            let slope = |a: f32, b: f32| 0.5 * (a * 0.31 + 0.4).sin() * (b * 0.17).cos();
            return (place, Vec3::new(slope(x, y), slope(y, x), 1.0).normalize());
        }
        (place, normal)
    }

    fn object(&self, x: f32, y: f32) -> Option<(Vec3, Vec3)> {
        let centre = self.ball();
        let (dx, dy) = (x - centre.x, y - centre.y);
        let rest = RADIUS * RADIUS - dx * dx - dy * dy;
        if !matches!(self.shape, Shape::Ball | Shape::Bump) || rest <= 0.0 {
            return None;
        }
        let place = Vec3::new(x, y, centre.z + rest.sqrt());
        let above = place.z > self.background(x, y).0.z;
        above.then(|| (place, (place - centre) / RADIUS))
    }

    /// Whether the ball keeps the light of a direction from a place of the background.
    fn is_shadowed(&self, place: Vec3, light: Vec3) -> bool {
        let to_centre = self.ball() - place;
        let along = to_centre.dot(light);
        along > 0.0
            && matches!(self.shape, Shape::Ball | Shape::Bump)
            && (to_centre - along * light).length() < RADIUS
    }

    fn print(&self, x: f32, y: f32) -> f32 {
        let checks = ((x + 400.0) / 9.0) as usize + ((y + 400.0) / 9.0) as usize;
        let checks = (checks % 2) as f32 - 0.5;
        1.0 + self.print * (checks + 0.5 * (x * 0.21 + (y * 0.13).sin()).sin())
    }

    fn brightness(&self, x: f32, y: f32, light: Vec3) -> f32 {
        let (place, normal, albedo, is_background) = match self.object(x, y) {
            Some((place, normal)) => (place, normal, self.albedo[0], false),
            None => {
                let (place, normal) = self.background(x, y);
                (place, normal, self.albedo[1] * self.print(x, y), true)
            }
        };
        if is_background && self.lit_by_room {
            return 0.6 * albedo;
        }
        let (light, fall) = match self.lamps {
            None => (light, 1.0),
            Some(distance) => {
                let way = light * distance - place;
                (way.normalize(), (distance / way.length()).powi(2))
            }
        };
        let lit = if is_background && self.is_shadowed(place, light) {
            0.0
        } else {
            1.0
        };
        albedo * fall * (AMBIENT + lit * normal.dot(light).max(0.0))
    }

    fn place(&self, pixel: usize) -> (f32, f32) {
        let width = WIDTH * self.scale;
        let scale = self.scale as f32;
        let x = ((pixel % width) as f32 + 0.5) / scale - WIDTH as f32 / 2.0;
        let y = HEIGHT as f32 / 2.0 - ((pixel / width) as f32 + 0.5) / scale;
        (x, y)
    }

    /// Twelve photographs on two rings of lamps.
    fn photographs(&self) -> ImageStack {
        let (width, height) = (WIDTH * self.scale, HEIGHT * self.scale);
        let images = (0..12).map(|k| {
            let (azimuth, polar) = (k as f32 * 0.55, [0.45f32, 0.8][k % 2]);
            let light = Vec3::new(
                polar.sin() * azimuth.cos(),
                polar.sin() * azimuth.sin(),
                polar.cos(),
            );
            let power = 0.7 + 0.3 * chance(k);
            let samples = (0..width * height).map(|pixel| {
                let (x, y) = self.place(pixel);
                let noise = 0.006 * (chance(pixel * 12 + k) - 0.5);
                power * self.brightness(x, y, light) + noise
            });
            StackImage {
                name: String::new(),
                width,
                height,
                channels: 1,
                samples: Samples::F32(samples.collect()),
                transfer: Transfer::Linear,
            }
        });
        ImageStack::new(images.collect()).unwrap()
    }

    fn truth(&self) -> Vec<bool> {
        let pixels = 0..WIDTH * HEIGHT * self.scale * self.scale;
        pixels
            .map(|pixel| {
                let (x, y) = self.place(pixel);
                self.object(x, y).is_some()
            })
            .collect()
    }
}

/// Intersection over union.
fn overlap(found: &[bool], truth: &[bool]) -> f32 {
    let pairs = || found.iter().zip(truth);
    let both = pairs().filter(|(a, b)| **a && **b).count();
    let any = pairs().filter(|(a, b)| **a || **b).count();
    both as f32 / any as f32
}

/// What brightness alone finds: the best of all thresholds on the brightest value over the images,
/// which is better than any rule can choose one.
fn best_threshold(stack: &ImageStack, truth: &[bool]) -> f32 {
    let brightest = stack.brightest();
    let trial = |k: usize| {
        let found: Vec<bool> = brightest
            .iter()
            .map(|&value| value > k as f32 / 100.0)
            .collect();
        overlap(&found, truth)
    };
    (0..100).map(trial).fold(0.0, f32::max)
}

#[test]
fn objects_are_told_from_their_backgrounds() {
    let dark = Scene {
        albedo: [0.5, 0.01],
        ..WALL
    };
    let bright = Scene {
        albedo: [0.4, 0.8],
        ..WALL
    };
    let printed = Scene { print: 0.7, ..WALL };
    let table = Scene {
        pitch: 0.7,
        print: 0.7,
        ..WALL
    };
    let near = Scene {
        lamps: Some(350.0),
        print: 0.5,
        ..WALL
    };
    let room = Scene {
        lit_by_room: true,
        albedo: [0.4, 0.7],
        ..WALL
    };
    let bump = Scene {
        shape: Shape::Bump,
        ..WALL
    };
    let printed_bump = Scene {
        shape: Shape::Bump,
        print: 0.5,
        ..WALL
    };
    let large = Scene {
        scale: 4,
        print: 0.7,
        ..WALL
    };
    // Brightness alone does on the dark wall only.
    for (name, scene, wanted, is_easy) in [
        ("dark wall", dark, 0.97, true),
        ("grey wall", WALL, 0.97, false),
        ("bright wall", bright, 0.97, false),
        ("printed wall", printed, 0.97, false),
        ("printed table", table, 0.97, false),
        ("printed wall, near lamps", near, 0.97, false),
        ("wall lit by the room", room, 0.97, false),
        ("bump", bump, 0.97, false),
        ("bump on print", printed_bump, 0.97, false),
        ("printed wall, large", large, 0.97, false),
    ] {
        let (stack, truth) = (scene.photographs(), scene.truth());
        let guess = Mask::guess(&stack);
        let found = overlap(guess.mask.inside(), &truth);
        let simple = best_threshold(&stack, &truth);
        println!(
            "{name}: {found:.3} (brightness {simple:.3}), certainty {:.2}",
            guess.certainty
        );
        assert!(found > wanted, "{name}: {found}");
        assert_eq!(simple > wanted, is_easy, "{name}: {simple}");
        assert!(!guess.is_whole_frame(), "{name}");
    }
}

#[test]
fn without_an_object_the_whole_frame_is_taken() {
    let empty = Scene {
        shape: Shape::Nothing,
        ..WALL
    };
    let printed = Scene {
        shape: Shape::Nothing,
        print: 0.7,
        ..WALL
    };
    let relief = Scene {
        shape: Shape::Relief,
        ..WALL
    };
    for scene in [empty, printed, relief] {
        let guess = Mask::guess(&scene.photographs());
        assert!(guess.is_whole_frame(), "{scene:?}: {}", guess.certainty);
        assert_eq!(guess.mask.count(), WIDTH * HEIGHT);
    }
}
