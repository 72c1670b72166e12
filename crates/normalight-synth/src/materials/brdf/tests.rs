use super::*;
use crate::materials::surface::Surface;
use glam::Vec3;
use std::f64::consts::PI;

/// What the camera sees of surfaces with the given normals, from a distant lamp.
fn shine(surface: Surface, normals: &[Vec3], to_camera: Vec3, lamp: Vec3) -> Vec<Vec3> {
    let count = normals.len();
    let points = Points::from_parts(
        vec![0; count],
        vec![Vec3::ZERO; count],
        normals.to_vec(),
        &vec![to_camera; count],
    );
    let surfaces = Surfaces::from_iter(std::iter::repeat_n(surface, count), normals, &[]);
    let lit = vec![1.0; points.normal[0].len()];
    let mut planes = std::array::from_fn(|_| vec![0.0; lit.len()]);
    shade(&points, &surfaces, &Lamp::distant(lamp), &lit, &mut planes);
    (0..count)
        .map(|k| Vec3::new(planes[0][k], planes[1][k], planes[2][k]))
        .collect()
}

fn shine_once(surface: Surface, normal: Vec3, to_camera: Vec3, lamp: Vec3) -> Vec3 {
    shine(surface, &[normal], to_camera, lamp)[0]
}

/// Directions of the upper hemisphere and their solid angles, by the midpoint rule in azimuth and in
/// the root of the cosine's distance from 1: more of them near the pole, where narrow lobes lie.
fn hemisphere() -> Vec<(Vec3, f64)> {
    let (rows, columns) = (500, 96);
    let mut directions = Vec::new();
    for row in 0..rows {
        let t = (row as f64 + 0.5) / rows as f64;
        let cosine = 1.0 - t * t;
        let sine = (1.0 - cosine * cosine).sqrt();
        let weight = 2.0 * t / rows as f64 * 2.0 * PI / columns as f64;
        for column in 0..columns {
            let angle = 2.0 * PI * (column as f64 + 0.5) / columns as f64;
            let direction = [sine * angle.cos(), sine * angle.sin(), cosine];
            directions.push((Vec3::from_array(direction.map(|x| x as f32)), weight));
        }
    }
    directions
}

fn mirror(alphas: [f32; 2]) -> Surface {
    Surface {
        f0: Vec3::ONE,
        alphas,
        weights: [1.0, 0.0],
        ..Surface::MATTE
    }
}

/// Share of the light from all around that a surface with its normal on z sends to a camera, by
/// reciprocity the share of a lamp's light that it sends anywhere: "directional albedo".
fn directional_albedo(surface: Surface, to_camera: Vec3) -> f64 {
    let lamps = hemisphere().into_iter();
    lamps
        .map(|(lamp, weight)| f64::from(shine_once(surface, Vec3::Z, to_camera, lamp).x) * weight)
        .sum::<f64>()
        / PI
}

#[test]
fn matte_surfaces_follow_the_cosine_and_return_their_albedo() {
    let surface = Surface {
        albedo: Vec3::new(0.5, 0.25, 1.0),
        ..Surface::MATTE
    };
    let normal = Vec3::new(0.0, 0.6, 0.8);
    let lamp = Vec3::new(0.48, 0.64, 0.6);
    let light = shine_once(surface, normal, Vec3::Z, lamp);
    let cosine = 0.6 * 0.64 + 0.8 * 0.6;
    assert!((light - Vec3::new(0.5, 0.25, 1.0) * cosine).length() < 1e-6);
    let behind = Vec3::new(0.0, -0.9, 0.1).normalize();
    assert_eq!(shine_once(surface, normal, Vec3::Z, behind), Vec3::ZERO);
    assert!((directional_albedo(surface, Vec3::Z) - 0.5).abs() < 1e-3);
}

#[test]
fn rough_facets_give_the_published_formula() {
    // Oren & Nayar (1994), equation 30, written with angles as they print it.
    let deviation = 0.4f64;
    let variance = deviation * deviation;
    let a = 1.0 - 0.5 * variance / (variance + 0.33);
    let b = 0.45 * variance / (variance + 0.09);
    let surface = Surface {
        albedo: Vec3::splat(0.8),
        facet_variance: variance as f32,
        ..Surface::MATTE
    };
    for (lamp_polar, view_polar, azimuth) in [(0.3, 0.9, 0.4), (1.1, 0.2, 2.5), (0.8, 0.8, 0.0)] {
        let vector = |polar: f64, azimuth: f64| {
            let (s, c) = polar.sin_cos();
            Vec3::new(
                (s * azimuth.cos()) as f32,
                (s * azimuth.sin()) as f32,
                c as f32,
            )
        };
        let light = shine_once(
            surface,
            Vec3::Z,
            vector(view_polar, 0.0),
            vector(lamp_polar, azimuth),
        );
        let (alpha, beta) = (lamp_polar.max(view_polar), lamp_polar.min(view_polar));
        let rest = azimuth.cos().max(0.0) * alpha.sin() * beta.tan();
        let expected = 0.8 * lamp_polar.cos() * (a + b * rest);
        assert!(
            (f64::from(light.x) - expected).abs() < 1e-5,
            "{light} {expected}"
        );
    }
}

/// A perfect mirror's facets return all light but what they hide from each other. Seen head-on, the share
/// is an integral over the facets instead of the lamps: `D (n.h) G` with `G = 1 / (1 + lambda)` (Heitz
/// 2014, equations 71, 72 and 99).
#[test]
fn mirrors_return_what_their_facets_do_not_hide() {
    for alpha in [0.1f32, 0.3, 0.5] {
        let square = f64::from(alpha * alpha);
        let (mut area, mut returned) = (0.0, 0.0);
        for (half, weight) in hemisphere() {
            let cosine = f64::from(half.z);
            let spread = cosine * cosine * (square - 1.0) + 1.0;
            let facets = square / (PI * spread * spread) * cosine * weight;
            area += facets;
            let lamp = 2.0 * cosine * cosine - 1.0;
            if lamp > 0.0 {
                let tangent = 1.0 / (lamp * lamp) - 1.0;
                let lambda = 0.5 * ((1.0 + square * tangent).sqrt() - 1.0);
                returned += facets / (1.0 + lambda);
            }
        }
        assert!((area - 1.0).abs() < 5e-3, "alpha {alpha}: {area}");
        let found = directional_albedo(mirror([alpha; 2]), Vec3::Z);
        assert!(
            (found - returned).abs() < 5e-3,
            "alpha {alpha}: {found} {returned}"
        );
    }
    for alphas in [[0.1f32, 0.1], [0.3, 0.1], [0.5, 0.5]] {
        for polar in [0.3f32, 0.9, 1.4] {
            let camera = Vec3::new(polar.sin(), 0.0, polar.cos());
            let total = directional_albedo(mirror(alphas), camera);
            assert!(
                (0.5..1.005).contains(&total),
                "{alphas:?}, {polar}: {total}"
            );
        }
    }
}

/// At normal incidence the correlated Smith term has a closed form: with `m = n.h`, lamp and camera
/// on the normal give `D / 4` with `D = 1 / (pi x y)`.
#[test]
fn head_on_highlight_has_its_closed_form() {
    for [x, y] in [[0.2f32, 0.2], [0.4, 0.1]] {
        let light = shine_once(mirror([x, y]), Vec3::Z, Vec3::Z, Vec3::Z);
        let expected = 1.0 / (4.0 * x * y);
        assert!(
            (light.x / expected - 1.0).abs() < 1e-4,
            "{light} {expected}"
        );
    }
}

#[test]
fn brushing_stretches_the_highlight() {
    // Brushed around y: the tangent on a surface facing z is x.
    let surface = mirror([0.4, 0.1]);
    let at =
        |x: f32, y: f32| shine_once(surface, Vec3::Z, Vec3::Z, Vec3::new(x, y, 1.0).normalize()).x;
    assert!(at(0.5, 0.0) > 3.0 * at(0.0, 0.5));
}

#[test]
fn lamp_and_camera_may_change_places() {
    let surface = Surface {
        albedo: Vec3::splat(0.4),
        facet_variance: 0.2,
        weights: [0.8, 0.3],
        wide_alpha: 0.6,
        f0: Vec3::splat(0.3),
        ..mirror([0.3, 0.15])
    };
    let a = Vec3::new(0.3, -0.5, 0.8).normalize();
    let b = Vec3::new(-0.6, 0.1, 0.5).normalize();
    let there = shine_once(surface, Vec3::Z, a, b) / b.z;
    let back = shine_once(surface, Vec3::Z, b, a) / a.z;
    assert!(
        (there - back).length() < 1e-5 * there.length(),
        "{there} {back}"
    );
}

/// In a furnace as bright everywhere as itself, white rough metal that loses nothing is invisible: what
/// single facets lose comes back from between them.
#[test]
fn rough_metal_returns_all_light() {
    for alpha in [0.2f32, 0.5, 0.9] {
        let whole = Surface {
            albedo: crate::materials::material::between_facets(Vec3::ONE, alpha),
            ..mirror([alpha; 2])
        };
        // Over all directions of the camera, by their cosine.
        let mean = |surface: Surface| {
            let count = 5;
            let camera = (0..count).map(|k| {
                let square = (k as f32 + 0.5) / count as f32;
                let to_camera = Vec3::new((1.0 - square).sqrt(), 0.0, square.sqrt());
                directional_albedo(surface, to_camera)
            });
            camera.sum::<f64>() / f64::from(count)
        };
        let returned = mean(whole);
        println!("alpha {alpha}: {returned:.3}");
        assert!((returned - 1.0).abs() < 0.02, "alpha {alpha}: {returned}");
    }
}
