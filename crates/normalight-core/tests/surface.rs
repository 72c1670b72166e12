//! What is made of depth, against closed forms.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
use normalight_core::{
    Bow, CoreError, DepthMap, DepthSettings, Integration, Mask, NormalMap, Projection,
    TriangleMesh, Vec3, integrate_normals,
};
use std::f32::consts::PI;

/// A square map of a height given by its slopes (to the right, up) at x right and y up of the middle.
fn depth_of(side: usize, slopes: impl Fn(f32, f32) -> Option<[f32; 2]>) -> (DepthMap, NormalMap) {
    let middle = (side as f32 - 1.0) / 2.0;
    let normals: Vec<Vec3> = (0..side * side)
        .map(|pixel| {
            let at = slopes(
                (pixel % side) as f32 - middle,
                middle - (pixel / side) as f32,
            );
            at.map_or(Vec3::ZERO, |[x, y]| Vec3::new(-x, -y, 1.0))
        })
        .collect();
    let inside = normals.iter().map(|&n| n != Vec3::ZERO).collect();
    let normals = NormalMap::new(side, side, normals);
    let mask = Mask::new(side, side, inside);
    let depth = integrate_normals(&normals, &mask, DepthSettings::default()).unwrap();
    (depth, normals)
}

/// A ball of radius 100 up to `reach` pixels from its middle.
fn cap(side: usize, reach: f32) -> (DepthMap, NormalMap) {
    depth_of(side, |x, y| {
        let height = (1e4 - x * x - y * y).max(0.0).sqrt();
        (x.hypot(y) < reach).then(|| [-x / height, -y / height])
    })
}

fn area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f32 {
    let areas = triangles.iter().map(|corners| {
        let [a, b, c] = corners.map(|corner| positions[corner as usize]);
        (b - a).cross(c - a).length() / 2.0
    });
    areas.sum()
}

#[test]
fn a_cap_has_the_area_of_a_cap() {
    let (depth, normals) = cap(181, 80.0);
    for (step, tolerance) in [(1, 0.002), (3, 0.01)] {
        let mesh = depth.mesh(&normals, step).unwrap();
        let found = area(&mesh.positions, &mesh.triangles);
        // 2 pi r h, for a rim as wide as the mesh, which ends in the middle of pixels.
        let flat: Vec<Vec3> = mesh.positions.iter().map(|p| p.with_z(0.0)).collect();
        let rim = area(&flat, &mesh.triangles) / PI;
        assert!(rim.sqrt() > 80.0 - 1.1 * step as f32);
        let truth = 2.0 * PI * 100.0 * (100.0 - (1e4f32 - rim).sqrt());
        assert!(
            (found / truth - 1.0).abs() < tolerance,
            "{step}: {found} for {truth}"
        );
        // All seen from the front, normals as those of the ball.
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            assert!((b - a).cross(c - a).z > 0.0);
        }
        for (vertex, normal) in mesh.normals.iter().enumerate() {
            let place = mesh.positions[vertex];
            assert!((normal.x - place.x / 100.0).abs() < 1e-4);
            let [right, down] = mesh.texture_place(vertex);
            assert!((place.x - (right - 0.5) * 181.0).abs() < 1e-3);
            assert!((place.y + (down - 0.5) * 181.0).abs() < 1e-3);
        }
    }
    // Euler: a disc without holes; every side belongs to one or two triangles.
    let mesh = depth.mesh(&normals, 1).unwrap();
    let mut sides: Vec<[u32; 2]> = mesh
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    sides.sort_unstable();
    let different = sides.chunk_by(|a, b| a == b);
    let counts: Vec<usize> = different.map(<[_]>::len).collect();
    assert!(counts.iter().all(|count| (1..=2).contains(count)));
    let euler = mesh.positions.len() + mesh.triangles.len() - counts.len();
    assert_eq!(euler, 1);
    assert!(TriangleMesh::new(mesh.positions, mesh.triangles).is_ok());
}

#[test]
fn no_triangle_spans_a_step() {
    let (depth, normals) = depth_of(120, |x, y| {
        Some(if x > 0.0 && y > 0.0 {
            [0.0, 0.8]
        } else {
            [0.0, 0.0]
        })
    });
    for step in [1, 4] {
        let mesh = depth.mesh(&normals, step).unwrap();
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            let rise = a.z.max(b.z).max(c.z) - a.z.min(b.z).min(c.z);
            let allowed = 0.8 * step as f32 + 4.0;
            assert!(rise < allowed, "{rise} at {a}");
        }
    }
    let all = depth.mesh(&normals, 1).unwrap().triangles.len();
    assert!(
        all > 2 * 119 * 119 - 130 && all < 2 * 119 * 119 - 80,
        "{all}"
    );
}

#[test]
fn steps_keep_meshes_small() {
    let (depth, normals) = depth_of(100, |_, _| Some([0.1, 0.1]));
    let step = depth.step_for(3000);
    assert_eq!(step, 3);
    assert!(depth.mesh(&normals, step).unwrap().triangles.len() <= 3000);
    assert_eq!(depth.step_for(usize::MAX), 1);
    let (dots, normals) = depth_of(9, |x, y| ((x + y) as i32 % 2 == 0).then_some([0.0; 2]));
    assert_eq!(dots.mesh(&normals, 1), Err(CoreError::NoTriangles));
}

#[test]
fn curvature_of_ball_plane_and_saddle() {
    let (depth, _) = cap(161, 70.0);
    let curvature = depth.mean_curvature();
    for pixel in depth.mask().pixels() {
        let place = depth.position(pixel);
        // At the border differences are one-sided.
        let tolerance = if place.x.hypot(place.y) < 67.0 {
            0.05
        } else {
            0.5
        };
        assert!(
            (curvature[pixel] * 100.0 - 1.0).abs() < tolerance,
            "{} at {place}",
            curvature[pixel]
        );
    }
    assert_eq!(curvature[0], 0.0);
    let (plane, _) = depth_of(40, |_, _| Some([0.5, -1.0]));
    assert!(
        plane
            .mean_curvature()
            .iter()
            .all(|value| value.abs() < 1e-3)
    );
    // z = x y / 100 is minimal where it is level.
    let (saddle, _) = depth_of(41, |x, y| Some([y / 100.0, x / 100.0]));
    assert!(saddle.mean_curvature()[20 * 41 + 20].abs() < 1e-5);
    // A hollow is negative.
    let (hollow, _) = depth_of(41, |x, y| Some([x / 50.0, y / 50.0]));
    let found = hollow.mean_curvature()[20 * 41 + 20];
    assert!((found + 0.02).abs() < 1e-3, "{found}");
}

#[test]
fn a_perspective_ball_has_its_curvature() {
    let (side, focal, radius) = (161usize, 300.0f32, 250.0f32);
    let centre = Vec3::new(30.0, 0.0, -900.0);
    let middle = (side as f32 - 1.0) / 2.0;
    let normals: Vec<Vec3> = (0..side * side)
        .map(|pixel| {
            let (x, y) = (
                (pixel % side) as f32 - middle,
                middle - (pixel / side) as f32,
            );
            let ray = Vec3::new(x, y, -focal).normalize();
            let along = ray.dot(centre);
            let half = radius * radius - (centre.length_squared() - along * along);
            let seen = half > 0.3 * radius * radius;
            if seen {
                ray * (along - half.sqrt()) - centre
            } else {
                Vec3::ZERO
            }
        })
        .collect();
    let inside = normals.iter().map(|&n| n != Vec3::ZERO).collect();
    let how = DepthSettings {
        projection: Projection::Perspective { focal },
        integration: Integration::Bilateral,
    };
    let normals = NormalMap::new(side, side, normals);
    let depth = integrate_normals(&normals, &Mask::new(side, side, inside), how).unwrap();
    // Its scale is unknown: width in pixels against width in truth.
    let pixel = 80 * side + 100;
    let truth = {
        let ray = Vec3::new(20.0, 0.0, -focal).normalize();
        let along = ray.dot(centre);
        (along - (radius * radius - (centre.length_squared() - along * along)).sqrt()) * -ray.z
    };
    let scale = (focal - depth.heights()[pixel]) / truth;
    let found = depth.mean_curvature()[pixel] * radius * scale;
    assert!((found - 1.0).abs() < 0.02, "{found}");
}

#[test]
fn the_sky_over_planes_and_grooves() {
    for slope in [0.0, 0.7] {
        let (plane, _) = depth_of(60, |_, _| Some([slope, 0.3]));
        for light in plane.ambient_occlusion(40.0) {
            assert!((light - 1.0).abs() < 0.01, "{light}");
        }
    }
    let (ball, _) = cap(121, 55.0);
    assert!(
        ball.ambient_occlusion(60.0)
            .iter()
            .all(|&light| light > 0.985)
    );
    // A groove along y whose walls rise at an angle b: they meet at 180 - 2 b degrees.
    for wall in [30f32, 45.0, 60.0] {
        let slope = wall.to_radians().tan();
        let (groove, _) = depth_of(241, |x, _| Some([slope * x.signum(), 0.0]));
        let light = groove.ambient_occlusion(1e4);
        let truth = (90.0 - wall).to_radians().sin().powi(2);
        // Near the bottom the walls are as good as endless.
        let found = light[120 * 241 + 123];
        assert!((found - truth).abs() < 0.04, "{wall}: {found} for {truth}");
        // Higher up more sky is seen.
        assert!(light[120 * 241 + 180] > found + 0.03);
    }
}

#[test]
fn a_bow_is_removed() {
    // A relief of small waves on a paraboloid, tilted.
    let wave = |x: f32, y: f32| [0.2 * (x * 0.5).sin(), 0.2 * (y * 0.4).cos()];
    let (bent, normals) = depth_of(160, |x, y| {
        let [p, q] = wave(x, y);
        Some([p + 0.1 + x / 400.0, q - 0.2 + x / 900.0])
    });
    let (bent_tilt, flat_normals) = (Bow::of(&bent), depth_of(160, |x, y| Some(wave(x, y))).1);
    let flat = bent_tilt.removed_from_depth(&bent);
    let (low, high) = flat.range();
    assert!(
        high - low < 4.0 && bent.range().1 - bent.range().0 > 30.0,
        "{low} to {high}"
    );
    let removed = bent_tilt.removed_from_normals(&normals);
    let cosines = removed.normals().iter().zip(flat_normals.normals());
    let mean = cosines.map(|(a, b)| a.dot(*b)).sum::<f32>() / 160.0 / 160.0;
    assert!(mean > 0.999, "{mean}");
    // Again there is nothing left to remove.
    let again = Bow::of(&flat).removed_from_depth(&flat);
    let off = again
        .heights()
        .iter()
        .zip(flat.heights())
        .map(|(a, b)| (a - b).abs());
    assert!(off.fold(0.0, f32::max) < 1e-3);
}
