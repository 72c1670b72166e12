use super::*;
use crate::lighting::{Lamp, Shadows};
use crate::random::{Random, Stream};

/// Degrees.
const CREASE: f32 = 40.0;

/// A torus around the z axis with analytic normals to compare with.
fn torus(rings: u32, sides: u32) -> TriangleMesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for side in 0..sides {
            let u = std::f32::consts::TAU * ring as f32 / rings as f32;
            let v = std::f32::consts::TAU * side as f32 / sides as f32;
            let out = 0.7 + 0.3 * v.cos();
            positions.push(Vec3::new(out * u.cos(), out * u.sin(), 0.3 * v.sin()));
            let place = |r: u32, s: u32| (r % rings) * sides + s % sides;
            let (a, b) = (place(ring, side), place(ring + 1, side));
            let (c, d) = (place(ring + 1, side + 1), place(ring, side + 1));
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriangleMesh::new(positions, triangles).unwrap()
}

fn window(inverse_distance: f32) -> Window {
    Window::square(0.0, 0.0, 2.2, 80, inverse_distance)
}

#[test]
fn torus_has_analytic_normals_and_depth() {
    for inverse_distance in [0.0, 0.2] {
        let mesh = Mesh::new(torus(200, 100), CREASE);
        // Turned, so that the hole is seen aslant.
        let turn = crate::random::about_x(0.5) * crate::random::about_y(0.3);
        let window = window(inverse_distance);
        let view = mesh.posed(turn).view(window, Detail::All);
        let mut seen = 0;
        for pixel in (0..80 * 80).filter(|&pixel| view.is_inside(pixel)) {
            let local = turn.transpose() * window.ray(pixel).at(view.depth[pixel]);
            let out = local.truncate().normalize() * 0.7;
            let expected = turn * (local - out.extend(0.0)).normalize();
            let distance = (local - out.extend(0.0)).length() - 0.3;
            assert!(distance.abs() < 2e-3, "{distance}");
            // At the very edge the facets' middles are not the torus'.
            let to_camera = window.ray(pixel).to_camera();
            if view.normals[pixel].dot(to_camera) > 0.1 {
                let degrees = view.normals[pixel].angle_between(expected).to_degrees();
                assert!(degrees < 1.5, "{degrees} degrees");
                seen += 1;
            }
        }
        assert!(seen > 1500, "{seen} pixels");
    }
}

#[test]
fn the_far_side_lies_behind_the_near_one() {
    let mesh = Mesh::new(torus(60, 30), CREASE);
    let view = mesh.posed(Mat3::IDENTITY).view(window(0.0), Detail::All);
    for pixel in (0..80 * 80).filter(|&pixel| view.is_inside(pixel)) {
        // Seen along its axis a torus is symmetric to the plane z = 0.
        assert!((view.depth[pixel] + view.back[pixel]).abs() < 0.03);
    }
}

#[test]
fn vertices_that_nothing_uses_change_nothing() {
    let mesh = torus(20, 10);
    let mut positions = mesh.positions().to_vec();
    positions.push(Vec3::new(1e3, 0.0, 0.0));
    let stray = TriangleMesh::new(positions, mesh.triangles().to_vec()).unwrap();
    let [one, two] = [mesh, stray].map(|mesh| {
        let mesh = Mesh::new(mesh, CREASE);
        mesh.posed(Mat3::IDENTITY)
            .view(window(0.0), Detail::All)
            .depth
    });
    assert_eq!(one, two);
}

/// Few large triangles, seen from nearby: a sphere whose smooth normals follow its flat faces' places
/// in space, not in the picture.
#[test]
fn normals_run_evenly_over_a_slanted_triangle() {
    let corners = [
        Vec3::new(-0.8, -0.4, -0.5),
        Vec3::new(0.8, -0.4, 0.5),
        Vec3::new(0.0, 0.6, 0.0),
    ];
    let mesh = TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
    let mut mesh = Mesh::new(mesh, CREASE);
    let normals = [
        Vec3::new(-0.5, 0.0, 0.8),
        Vec3::new(0.5, 0.0, 0.8),
        Vec3::new(0.0, 0.5, 0.8),
    ];
    mesh.normals.normals = normals.to_vec();
    let posed = mesh.posed(Mat3::IDENTITY);
    let [a, b, c] = [0, 1, 2].map(|corner| posed.places[corner]);
    let window = window(0.35);
    let view = posed.view(window, Detail::All);
    let mut seen = 0;
    for pixel in (0..80 * 80).filter(|&pixel| view.is_inside(pixel)) {
        // Weights by areas in space.
        let place = window.ray(pixel).at(view.depth[pixel]);
        let whole = (b - a).cross(c - a).length();
        let u = (place - a).cross(c - a).length() / whole;
        let v = (b - a).cross(place - a).length() / whole;
        let expected = normals[0] * (1.0 - u - v) + normals[1] * u + normals[2] * v;
        let degrees = view.normals[pixel]
            .angle_between(expected.normalize())
            .to_degrees();
        assert!(degrees < 0.3, "{degrees} degrees");
        seen += 1;
    }
    assert!(seen > 300, "{seen}");
}

/// Whatever triangles are turned round, as long as they are less than half.
#[test]
fn a_torus_partly_inside_out_looks_as_ever() {
    let mesh = torus(60, 30);
    let mut random = Random::new(3, Stream::Shape);
    let turned = mesh
        .triangles()
        .iter()
        .map(|&[a, b, c]| match random.chance(0.4) {
            true => [a, c, b],
            false => [a, b, c],
        });
    let mixed = TriangleMesh::new(mesh.positions().to_vec(), turned.collect()).unwrap();
    let turn = crate::random::about_x(0.7);
    let [one, two] = [mesh, mixed].map(|mesh| {
        let view = Mesh::new(mesh, CREASE)
            .posed(turn)
            .view(window(0.1), Detail::All);
        (view.depth, view.back, view.normals)
    });
    assert!(one == two);
}

/// The facets of a cube meet at right angles: each has its own normal right up to the edge.
#[test]
fn a_cube_has_three_normals() {
    let at = |corner: u32, bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let place = |corner| Vec3::new(at(corner, 0), at(corner, 1), at(corner, 2));
    // Some of them inside out.
    let triangles = vec![
        [0, 2, 3],
        [0, 3, 1],
        [4, 7, 5],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 2, 6],
        [1, 3, 7],
        [1, 7, 5],
    ];
    let mesh = TriangleMesh::new((0..8).map(place).collect(), triangles).unwrap();
    let turn = crate::random::about_x(0.6) * crate::random::about_y(0.5);
    let mesh = Mesh::new(mesh, CREASE);
    let view = mesh.posed(turn).view(window(0.0), Detail::All);
    let mut counts = [0; 3];
    for pixel in (0..80 * 80).filter(|&pixel| view.is_inside(pixel)) {
        let local = turn.transpose() * view.normals[pixel];
        let axis = local.abs().max_position();
        assert!(local.abs()[axis] > 1.0 - 1e-5, "{local}");
        counts[axis] += 1;
    }
    assert!(counts.iter().all(|&count| count > 300), "{counts:?}");
}

/// A prism of twelve sides is smooth by its crease angle; seen from the side, its outermost normals lie at
/// right angles to the view, and yet nothing of it is lost.
#[test]
fn normals_at_the_edge_face_the_camera() {
    let sides = 12u32;
    let around = |side: u32| std::f32::consts::TAU * side as f32 / sides as f32;
    let positions = (0..2 * sides).map(|k| {
        let (angle, end) = (around(k / 2), if k % 2 == 0 { -1.0 } else { 1.0 });
        Vec3::new(0.6 * angle.cos(), end, 0.6 * angle.sin())
    });
    let triangles = (0..sides).flat_map(|side| {
        let next = (side + 1) % sides;
        let [a, b, c, d] = [2 * side, 2 * side + 1, 2 * next + 1, 2 * next];
        [[a, b, c], [a, c, d]]
    });
    let mesh = TriangleMesh::new(positions.collect(), triangles.collect()).unwrap();
    let mesh = Mesh::new(mesh, CREASE);
    let reach = (1.0f32 + 0.36).sqrt();
    let window = Window::square(0.0, 0.0, 2.2, 220, 0.0);
    let view = mesh.posed(Mat3::IDENTITY).view(window, Detail::All);
    for column in 0..220 {
        let (x, pixel) = (window.x(column), 110 * 220 + column);
        let half = 0.6 / reach;
        if (x.abs() - half).abs() > 1e-4 {
            assert_eq!(view.is_inside(pixel), x.abs() < half, "{x}");
        }
        if view.is_inside(pixel) {
            assert!(view.normals[pixel].z > 0.02, "{x}: {}", view.normals[pixel]);
        }
    }
}

/// A square sheet over a sheet of ground, lit at 45 degrees: its shadow is a square as large as itself and
/// as far aside as it is high.
#[test]
fn an_open_sheet_casts_its_shadow() {
    let (high, half, ground) = (0.3, 0.2, 0.9);
    let square = |half: f32, z: f32| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| Vec3::new(half * x, half * y, z))
    };
    let positions = [square(ground, 0.0), square(half, high)].concat();
    let sheets = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    let mesh = Mesh::new(TriangleMesh::new(positions, sheets).unwrap(), CREASE);
    // What the mesh was made smaller by, around the middle of its heights.
    let scale = mesh.positions[1].x / ground;
    let [high, half, ground] = [high, half, ground].map(|length| length * scale);
    let side = 160;
    for inverse_distance in [0.0, 0.1] {
        let window = Window::square(0.0, 0.0, 1.6, side, inverse_distance);
        let view = mesh.posed(Mat3::IDENTITY).view(window, Detail::All);
        let lamp = Lamp::distant(Vec3::new(-1.0, 0.0, 1.0).normalize());
        let lit = Shadows::new(&view).lit(&lamp);
        let (mut dark, mut wrong) = (0, 0);
        for pixel in (0..side * side).filter(|&pixel| view.is_inside(pixel)) {
            let place = window.ray(pixel).at(view.depth[pixel]);
            let [x, y] = [place.x - high, place.y].map(|length| length.abs() - half);
            // Neither the sheet itself, nor what lies within a pixel and a half of the shadow's edge.
            let near = x.max(y).abs() < 1.5 * window.pitch;
            if place.z > 0.0 || near || place.truncate().abs().max_element() > ground {
                continue;
            }
            let shadowed = x.max(y) < 0.0;
            dark += usize::from(shadowed);
            wrong += usize::from(shadowed != (lit[pixel] < 0.5));
        }
        assert!(dark > 400, "{dark}");
        assert_eq!(wrong, 0, "of {dark}");
    }
}
