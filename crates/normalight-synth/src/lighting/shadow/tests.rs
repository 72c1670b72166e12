use super::*;
use crate::random::{Random, Stream};
use crate::recipe::ShapeRecipe;
use crate::shapes::{Detail, Library, Object, Window, object};

fn view(window: Window, depth: impl Fn(f32, f32) -> f32, back: f32) -> View {
    let area = window.width * window.height;
    let at = |pixel: usize| {
        depth(
            window.x(pixel % window.width),
            window.y(pixel / window.width),
        )
    };
    let depth: Vec<f32> = (0..area).map(at).collect();
    View::from_planes(window, depth, vec![back; area], vec![Vec3::Z; area])
}

fn window(side: usize) -> Window {
    Window::square(0.0, 0.0, 4.0, side, 0.0)
}

#[test]
fn a_wall_shades_the_floor_behind_it() {
    // A floor at z = 0 with a wall of height 0.5 on the left part, x < 0.
    let window = window(64);
    let view = view(window, |x, _| if x < 0.0 { 0.5 } else { 0.0 }, -0.1);
    let shadows = Shadows::new(&view);
    let at = |lit: &[f32], x: f32| {
        let column = ((x - window.left) / window.pitch) as usize;
        lit[32 * 64 + column]
    };
    // 45 degrees from the left: the shadow is as long as the wall is high.
    let from_left = shadows.lit(&Lamp::distant(Vec3::new(-1.0, 0.0, 1.0).normalize()));
    assert_eq!(at(&from_left, 0.25), 0.0);
    assert_eq!(at(&from_left, 0.75), 1.0);
    // From the right nothing is in the way.
    let from_right = shadows.lit(&Lamp::distant(Vec3::new(1.0, 0.0, 1.0).normalize()));
    assert_eq!(at(&from_right, 0.25), 1.0);
    assert_eq!(at(&from_right, -0.25), 1.0);
}

#[test]
fn light_passes_under_what_floats() {
    // A bar from z = 0.9 to 1 over the left half of the floor; its shadow does not reach back to it.
    let window = window(64);
    let area = 64 * 64;
    let over = |pixel: usize| (-0.5..0.0).contains(&window.x(pixel % 64));
    let depth = (0..area).map(|p| if over(p) { 1.0 } else { 0.0 }).collect();
    let back = (0..area)
        .map(|p| if over(p) { 0.9 } else { -0.1 })
        .collect();
    let view = View::from_planes(window, depth, back, vec![Vec3::Z; area]);
    let lit = Shadows::new(&view).lit(&Lamp::distant(Vec3::new(-1.0, 0.0, 1.0).normalize()));
    let at = |x: f32| lit[32 * 64 + ((x - window.left) / window.pitch) as usize];
    assert_eq!(at(0.25), 1.0, "under the bar");
    assert_eq!(at(0.7), 0.0, "in its shadow");
    assert_eq!(at(1.3), 1.0, "beyond it");
}

/// The shadows of drawn solids against rays followed through their signed distance.
#[test]
fn shadows_are_those_of_ray_casting() {
    let (recipe, library) = (ShapeRecipe::default(), Library::default());
    for inverse_distance in [0.0, 0.15] {
        let (mut points, mut wrong) = (0, 0);
        for seed in 0..16 {
            let mut random = Random::new(seed, Stream::Shape);
            let object = object(&recipe, &library, &mut random);
            let Object::Solid(shape) = &object else {
                unreachable!("no meshes were given");
            };
            let side = 96;
            let reach =
                1.1 * object.extent().max_element() / (1.0 - inverse_distance * object.reach());
            let window = Window::square(0.0, 0.0, 2.0 * reach, side, inverse_distance);
            let view = object.view(window, Detail::All);
            let shadows = Shadows::new(&view);
            for _ in 0..4 {
                let direction = Vec3::new(random.signed(1.0), random.signed(1.0), 0.8).normalize();
                let lamp = if random.chance(0.5) {
                    Lamp::distant(direction)
                } else {
                    Lamp::near(direction, 5.0)
                };
                let lit = shadows.lit(&lamp);
                for pixel in (0..side * side).filter(|&pixel| view.is_inside(pixel)) {
                    let place = window.ray(pixel).at(view.depth[pixel]);
                    let to_lamp = lamp.direction_from(place);
                    // Turned away surfaces are dark anyway.
                    if view.normals[pixel].dot(to_lamp) < 0.05 {
                        continue;
                    }
                    points += 1;
                    let truth = shape.is_lit(place + view.normals[pixel] * window.pitch, to_lamp);
                    wrong += usize::from(truth != (lit[pixel] > 0.5));
                }
            }
        }
        let share = wrong as f32 / points as f32;
        println!("{wrong} of {points} points differ, {:.2} %", 100.0 * share);
        assert!(share < 0.03, "{wrong} of {points}");
    }
}
