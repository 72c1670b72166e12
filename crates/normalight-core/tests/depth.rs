//! Depth against closed forms.
use normalight_core::{
    CoreError, DepthMap, DepthSettings, Integration, Mask, NormalMap, Projection, Vec3,
    integrate_normals,
};

const BOTH: [Integration; 2] = [Integration::Bilateral, Integration::Poisson];

fn settings(integration: Integration) -> DepthSettings {
    DepthSettings {
        projection: Projection::Orthographic,
        integration,
    }
}

/// Normals and mask of a square map, from the normal at x right and y up of its middle; zero is outside.
fn map(side: usize, normal: impl Fn(f32, f32) -> Vec3) -> (NormalMap, Mask) {
    let middle = (side as f32 - 1.0) / 2.0;
    let at = |pixel: usize| {
        normal(
            (pixel % side) as f32 - middle,
            middle - (pixel / side) as f32,
        )
    };
    let normals: Vec<Vec3> = (0..side * side).map(at).collect();
    let inside = normals.iter().map(|&n| n != Vec3::ZERO).collect();
    (
        NormalMap::new(side, side, normals),
        Mask::new(side, side, inside),
    )
}

/// Root mean square of what differs from the true heights, whose mean over the mask does not count.
fn error(depth: &DepthMap, truth: impl Fn(Vec3) -> f32) -> f32 {
    let pixels = depth.mask().pixels();
    let off = |&pixel: &usize| depth.heights()[pixel] - truth(depth.position(pixel));
    let mean = pixels.iter().map(off).sum::<f32>() / pixels.len() as f32;
    let squares: f32 = pixels.iter().map(|pixel| (off(pixel) - mean).powi(2)).sum();
    (squares / pixels.len() as f32).sqrt()
}

fn of_slopes(x: f32, y: f32) -> Vec3 {
    Vec3::new(-x, -y, 1.0).normalize()
}

#[test]
fn a_plane_is_exact() {
    for integration in BOTH {
        for side in [5, 64, 301] {
            let (normals, mask) = map(side, |_, _| of_slopes(0.7, -0.4));
            let depth = integrate_normals(&normals, &mask, settings(integration)).unwrap();
            let error = error(&depth, |p| 0.7 * p.x - 0.4 * p.y);
            assert!(
                error < 1e-5 * side as f32,
                "{integration:?} {side}: {error}"
            );
            let mean: f32 = depth.heights().iter().sum::<f32>() / (side * side) as f32;
            assert!(mean.abs() < 1e-3);
            assert_eq!((depth.parts(), depth.missing(), depth.steep()), (1, 0, 0));
            assert_eq!(depth.torn(), 0.0);
        }
    }
}

#[test]
fn a_sphere_cap_is_round() {
    for integration in BOTH {
        let radius = 100.0;
        let (normals, mask) = map(181, |x, y| match x.hypot(y) < 85.0 {
            true => Vec3::new(x, y, (radius * radius - x * x - y * y).sqrt()),
            false => Vec3::ZERO,
        });
        let depth = integrate_normals(&normals, &mask, settings(integration)).unwrap();
        let error = error(&depth, |p| (radius * radius - p.x * p.x - p.y * p.y).sqrt());
        assert!(error < 0.02, "{integration:?}: {error} pixels");
        assert_eq!(depth.torn(), 0.0);
        assert_eq!(depth.heights()[0], 0.0);
    }
}

/// Up to its outline a half ball is as steep as can be.
#[test]
fn a_half_ball_has_no_spikes() {
    let radius = 60.0f32;
    let height = |x: f32, y: f32| (radius * radius - x * x - y * y).max(0.0).sqrt();
    let (normals, mask) = map(141, |x, y| match x.hypot(y) < radius {
        true => Vec3::new(x, y, height(x, y)),
        false => Vec3::ZERO,
    });
    let depth = integrate_normals(&normals, &mask, settings(Integration::Bilateral)).unwrap();
    let error = error(&depth, |p| height(p.x, p.y));
    assert!(error < 0.01 * radius, "{error} pixels");
    let (low, high) = depth.range();
    assert!(high - low < 1.05 * radius, "{low} to {high}");
}

/// Flat but for a quarter that rises from one of its sides: along the other there is a step that grows
/// from nothing to half its slope times the side of the map.
fn ramp(x: f32, y: f32) -> f32 {
    if x > 0.0 && y > 0.0 { 0.6 * y } else { 0.0 }
}

#[test]
fn a_step_stays_a_step() {
    let (normals, mask) = map(200, |x, y| match x > 0.0 && y > 0.0 {
        true => of_slopes(0.0, 0.6),
        false => Vec3::Z,
    });
    let [bilateral, poisson] = BOTH.map(|integration| {
        let depth = integrate_normals(&normals, &mask, settings(integration)).unwrap();
        (error(&depth, |p| ramp(p.x, p.y)), depth)
    });
    assert!(bilateral.0 < 0.5, "{} pixels", bilateral.0);
    assert!(poisson.0 > 5.0, "{} pixels", poisson.0);
    // The step is found where it is, and nowhere else.
    let depth = bilateral.1;
    for pixel in depth.mask().pixels() {
        let place = depth.position(pixel);
        let at_step = place.x == -0.5 && place.y > 0.0;
        if depth.breaks_right(pixel) {
            assert!(at_step, "torn at {place}");
        } else if at_step {
            assert!(place.y < 8.0, "not torn at {place}");
        }
        assert!(!depth.breaks_below(pixel));
    }
}

#[test]
fn a_perspective_plane_is_flat() {
    // Points p with p . n = -distance, seen from the origin along -z.
    let (side, focal) = (201usize, 250.0);
    let tilt = Vec3::new(-0.3, 0.2, 1.0).normalize();
    let (normals, mask) = map(side, |_, _| tilt);
    for integration in BOTH {
        let how = DepthSettings {
            projection: Projection::Perspective { focal },
            integration,
        };
        let depth = integrate_normals(&normals, &mask, how).unwrap();
        let camera = Vec3::Z * focal;
        let from_plane = |pixel| (depth.position(pixel) - camera).dot(tilt);
        let mean = from_plane(side * side / 2);
        for pixel in 0..side * side {
            let off = from_plane(pixel) / mean;
            assert!(
                (off - 1.0).abs() < 1e-3,
                "{integration:?}: {off} at {pixel}"
            );
        }
    }
}

#[test]
fn a_perspective_sphere_is_round() {
    let (side, focal) = (201usize, 300.0);
    let (centre, radius) = (Vec3::new(40.0, -20.0, -1000.0), 300.0f32);
    // The near point of each ray that meets the ball, but for its rim.
    let hit = |x: f32, y: f32| {
        let ray = Vec3::new(x, y, -focal).normalize();
        let along = ray.dot(centre);
        let half = radius * radius - (centre.length_squared() - along * along);
        (half > 0.1 * radius * radius).then(|| ray * (along - half.sqrt()))
    };
    let (normals, mask) = map(side, |x, y| {
        hit(x, y).map_or(Vec3::ZERO, |point| (point - centre) / radius)
    });
    let how = DepthSettings {
        projection: Projection::Perspective { focal },
        integration: Integration::Bilateral,
    };
    let depth = integrate_normals(&normals, &mask, how).unwrap();
    let middle = (side as f32 - 1.0) / 2.0;
    let pixels = mask.pixels();
    let ratios: Vec<f32> = pixels
        .iter()
        .map(|&pixel| {
            let truth = hit(
                (pixel % side) as f32 - middle,
                middle - (pixel / side) as f32,
            );
            (focal - depth.heights()[pixel]) / -truth.unwrap().z
        })
        .collect();
    let scale = ratios.iter().sum::<f32>() / ratios.len() as f32;
    for ratio in ratios {
        assert!(
            (ratio / scale - 1.0).abs() < 5e-4,
            "{ratio} against {scale}"
        );
    }
    // As if from far away it would be bent.
    let flat = integrate_normals(&normals, &mask, settings(Integration::Bilateral)).unwrap();
    let wrong = pixels.iter().any(|&pixel| {
        let wanted = depth.heights()[pixel] / scale;
        (flat.heights()[pixel] - wanted).abs() > 10.0
    });
    assert!(wrong);
}

/// Two squares and a bridge that is one pixel wide; and one pixel on its own.
#[test]
fn parts_and_narrow_parts() {
    let (width, height) = (60, 20);
    let inside: Vec<bool> = (0..width * height)
        .map(|pixel| {
            let (x, y) = (pixel % width, pixel / width);
            let body = (1..15).contains(&x) || (25..40).contains(&x);
            let bridge = y == 9 && x < 40 && x > 0;
            let other = (45..55).contains(&x);
            (body || other) && (1..18).contains(&y) || bridge || (x, y) == (58, 5)
        })
        .collect();
    let mask = Mask::new(width, height, inside);
    let normals = NormalMap::new(width, height, vec![of_slopes(0.5, 0.2); width * height]);
    for integration in BOTH {
        let depth = integrate_normals(&normals, &mask, settings(integration)).unwrap();
        assert_eq!(depth.parts(), 3);
        let off = |pixel: usize| {
            let place = depth.position(pixel);
            depth.heights()[pixel] - 0.5 * place.x - 0.2 * place.y
        };
        let first = off(9 * width + 1);
        for pixel in mask.pixels().into_iter().filter(|pixel| pixel % width < 40) {
            assert!((off(pixel) - first).abs() < 2e-3, "{integration:?} {pixel}");
        }
        let second: Vec<f32> = mask
            .pixels()
            .into_iter()
            .filter(|pixel| (45..55).contains(&(pixel % width)))
            .map(|pixel| depth.heights()[pixel])
            .collect();
        assert!((second.iter().sum::<f32>() / second.len() as f32).abs() < 1e-3);
        assert_eq!(depth.heights()[5 * width + 58], 0.0);
    }
}

#[test]
fn unusable_normals_are_filled_in_and_counted() {
    let mut normals = vec![of_slopes(0.3, 0.0); 50 * 50];
    let hole = |pixel: usize| (20..24).contains(&(pixel % 50)) && (20..24).contains(&(pixel / 50));
    for (pixel, normal) in normals.iter_mut().enumerate() {
        if hole(pixel) {
            *normal = Vec3::splat(f32::NAN);
        }
    }
    normals[30 * 50 + 30] = Vec3::new(0.6, 0.0, -0.8);
    normals[31 * 50 + 30] = Vec3::new(1.0, 0.0, 0.001);
    let normals = NormalMap::new(50, 50, normals);
    for integration in BOTH {
        let depth =
            integrate_normals(&normals, &Mask::whole(50, 50), settings(integration)).unwrap();
        assert_eq!((depth.missing(), depth.steep()), (16, 2));
        let error = error(&depth, |p| 0.3 * p.x);
        assert!(error < 0.05, "{integration:?}: {error}");
        assert!(depth.heights().iter().all(|height| height.is_finite()));
    }
}

#[test]
fn nothing_usable_is_flat() {
    let normals = NormalMap::new(9, 7, vec![Vec3::ZERO; 63]);
    let depth = integrate_normals(&normals, &Mask::whole(9, 7), DepthSettings::default()).unwrap();
    assert_eq!(depth.missing(), 63);
    assert_eq!(depth.range(), (0.0, 0.0));
    assert_eq!(depth.position(0), Vec3::new(-4.0, 3.0, 0.0));
}

#[test]
fn faults_are_named() {
    let normals = NormalMap::new(4, 4, vec![Vec3::Z; 16]);
    let integrate = |mask: &Mask, projection| {
        let how = DepthSettings {
            projection,
            ..DepthSettings::default()
        };
        integrate_normals(&normals, mask, how).unwrap_err()
    };
    let ortho = Projection::Orthographic;
    let error = integrate(&Mask::whole(4, 5), ortho);
    assert!(matches!(error, CoreError::MapSize { .. }));
    let error = integrate(&Mask::new(4, 4, vec![false; 16]), ortho);
    assert!(matches!(error, CoreError::EmptyMask { .. }));
    for focal in [0.0, -3.0, f32::NAN, f32::INFINITY] {
        let error = integrate(&Mask::whole(4, 4), Projection::Perspective { focal });
        assert!(matches!(error, CoreError::FocalLength { .. }), "{error}");
    }
}
