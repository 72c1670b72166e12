use super::*;
use crate::materials::Surfaces;
use crate::materials::surface_for_tests as matte;
use crate::shapes::Window;

/// Bounces followed by the brute force; what is left after them is a thousandth.
const BOUNCES: usize = 30;

/// All bounces from every point to every other one that it sees, pixel by pixel.
fn brute_force(view: &View, points: &Points, albedo: f32, irradiance: &[f32]) -> Vec<f32> {
    let window = view.window;
    let visible = |a: Vec3, b: Vec3| {
        // Along the straight line nothing may stand in front.
        let steps = ((b - a).truncate().length() / (0.5 * window.pitch)) as usize;
        (1..steps).all(|step| {
            let place = a.lerp(b, step as f32 / steps as f32);
            let column = ((place.x - window.left) / window.pitch) as usize;
            let row = ((window.top - place.y) / window.pitch) as usize;
            view.depth[row * window.width + column] < place.z + 1.5 * window.pitch
        })
    };
    let count = points.count();
    let mut exchange = vec![0.0f32; count * count];
    for to in 0..count {
        let (place, normal) = (points.places[to], points.normals[to]);
        for from in 0..count {
            let between = points.places[from] - place;
            let (out, back) = (between.dot(normal), -between.dot(points.normals[from]));
            if out <= 0.0 || back <= 0.0 || !visible(place, points.places[from]) {
                continue;
            }
            let area = window.pitch * window.pitch / points.normals[from].z;
            let square = between.length_squared();
            exchange[to * count + from] = out * back * area / (square * (PI * square + area));
        }
    }
    // What all points scatter of the lamp's light, then of that, and so on.
    let mut leaving: Vec<f32> = irradiance[..count].iter().map(|i| albedo * i).collect();
    let mut all = vec![0.0; count];
    for _ in 0..BOUNCES {
        let rows = exchange.chunks_exact(count);
        let arriving = rows.map(|row| row.iter().zip(&leaving).map(|(e, l)| e * l).sum::<f32>());
        leaving = arriving.map(|arriving| albedo * arriving).collect();
        for (sum, leaving) in all.iter_mut().zip(&leaving) {
            *sum += leaving;
        }
    }
    all
}

fn bounced(view: &View, points: &Points, albedo: f32, irradiance: &[f32]) -> Vec<f32> {
    let surfaces = Surfaces::from_iter(
        std::iter::repeat_n(matte(albedo), points.count()),
        &points.normals,
        &[],
    );
    let mut irradiance = irradiance.to_vec();
    irradiance.resize(points.normal[0].len(), 0.0);
    let mut radiance = [std::array::from_fn(|_| vec![0.0; irradiance.len()])];
    Bounces::new(view, points).add(points, &surfaces, &[irradiance], &mut radiance);
    radiance[0][0][..points.count()].to_vec()
}

/// A bowl: the inside of a sphere of radius 1, cut where its wall is as steep as `least` (normal's z).
fn bowl(side: usize, least: f32) -> View {
    let window = Window::square(0.0, 0.0, 2.0, side, 0.0);
    let mut depth = vec![f32::NEG_INFINITY; side * side];
    let mut normals = vec![Vec3::ZERO; side * side];
    for pixel in 0..side * side {
        let (x, y) = (window.x(pixel % side), window.y(pixel / side));
        let height = (1.0 - x * x - y * y).max(0.0).sqrt();
        if height > least {
            depth[pixel] = -height;
            normals[pixel] = Vec3::new(-x, -y, height);
        }
    }
    View::from_planes(window, depth, vec![-1.2; side * side], normals)
}

/// Inside a sphere every point sees every other one equally well: the form factor of a piece is its
/// share `f` of the sphere's surface. Evenly lit pieces send `albedo * f` of their light with the first
/// bounce, as much of that with the second, and `albedo * f / (1 - albedo * f)` with all.
#[test]
fn a_bowl_gets_what_its_share_of_the_sphere_sends() {
    let least = 0.3;
    let view = bowl(96, least);
    let points = Points::new(&view);
    let albedo = 0.8;
    let light = bounced(&view, &points, albedo, &vec![1.0; points.count()]);
    let area = 2.0 * PI * (1.0 - least);
    let again = albedo * area / (4.0 * PI);
    let expected = albedo * again / (1.0 - again);
    let mean = light.iter().sum::<f32>() / light.len() as f32;
    // Near neighbours are taken for less than they give, to stay finite.
    println!("{:.1} % of the closed form", 100.0 * mean / expected);
    assert!(
        (mean / expected - 1.0).abs() < 0.12,
        "{mean} against {expected}"
    );
}

#[test]
fn patches_come_near_the_brute_force() {
    let side = 32;
    let window = Window::square(0.0, 0.0, 2.0, side, 0.0);
    // A valley whose walls face each other, and a bumpy ground.
    let valley = |x: f32, _: f32| x.abs();
    let bumps = |x: f32, y: f32| 0.25 * (5.0 * x).sin() * (4.0 * y).cos();
    type Height<'a> = &'a dyn Fn(f32, f32) -> f32;
    for (name, height) in [("valley", &valley as Height), ("bumps", &bumps)] {
        let (mut depth, mut normals) = (Vec::new(), Vec::new());
        for pixel in 0..side * side {
            let (x, y) = (window.x(pixel % side), window.y(pixel / side));
            let h = 1e-3;
            let slope_x = (height(x + h, y) - height(x - h, y)) / (2.0 * h);
            let slope_y = (height(x, y + h) - height(x, y - h)) / (2.0 * h);
            depth.push(height(x, y));
            normals.push(Vec3::new(-slope_x, -slope_y, 1.0).normalize());
        }
        let view = View::from_planes(window, depth, vec![-1.0; side * side], normals);
        let points = Points::new(&view);
        let lamp = Vec3::new(0.5, 0.2, 0.8).normalize();
        let irradiance: Vec<f32> = points
            .normals
            .iter()
            .map(|n| n.dot(lamp).max(0.0))
            .collect();
        let truth = brute_force(&view, &points, 0.8, &irradiance);
        let light = bounced(&view, &points, 0.8, &irradiance);
        let total: f32 = truth.iter().sum();
        let off: f32 = truth.iter().zip(&light).map(|(a, b)| (a - b).abs()).sum();
        println!(
            "{name}: {:.1} % off, sum {:.1} %",
            100.0 * off / total,
            100.0 * light.iter().sum::<f32>() / total
        );
        assert!(off < 0.35 * total, "{name}: {off} of {total}");
    }
}
