//! How far integrated depth is from the truth on meshes, whose exact normals are integrated:
//! `cargo run --release -p normalight-io --example depth_errors -- 256 mesh.ply ...`.
//!
//! Prints a table: median and root mean square of the heights' error, in percent of the object's larger
//! side, and the same of plain least squares; each connected part may be moved along the line of sight.
use normalight_core::{
    DepthSettings, Integration, Mask, NormalMap, Projection, TriangleMesh, Vec3, integrate_normals,
};
use normalight_io::read_mesh;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let side: usize = arguments.next().ok_or("expected: SIDE MESH ...")?.parse()?;
    println!("mesh, steps %, bilateral median %, rms %, Poisson median %, rms %, torn %");
    let mut sums = [0.0f32; 4];
    let mut count = 0;
    for name in arguments {
        let mesh = read_mesh(&name, &std::fs::read(&name)?)?.oriented();
        let view = View::of(&mesh, side);
        let mut row = Vec::new();
        let mut torn = 0.0;
        for integration in [Integration::Bilateral, Integration::Poisson] {
            let how = DepthSettings {
                projection: Projection::Orthographic,
                integration,
            };
            let depth = integrate_normals(&view.normals, &view.mask, how)?;
            torn = f32::max(torn, depth.torn());
            row.extend(view.errors(depth.heights()));
        }
        for (sum, value) in sums.iter_mut().zip(&row) {
            *sum += value;
        }
        count += 1;
        let name = name.rsplit('/').next().unwrap_or_default();
        println!(
            "{name}, {:.1}, {:.2}, {:.2}, {:.2}, {:.2}, {:.1}",
            100.0 * view.steps(),
            row[0],
            row[1],
            row[2],
            row[3],
            100.0 * torn
        );
    }
    let means = sums.map(|sum| format!("{:.2}", sum / count.max(1) as f32));
    println!("mean of {count}: {}", means.join(", "));
    Ok(())
}

/// A mesh seen from the front.
struct View {
    side: usize,
    mask: Mask,
    normals: NormalMap,
    heights: Vec<f32>,
}

impl View {
    /// The nearest triangle in the middle of each pixel; the mesh fills nine tenths of the picture.
    fn of(mesh: &TriangleMesh, side: usize) -> Self {
        let (low, high) = mesh.bounds();
        let middle = (low + high) / 2.0;
        let scale = 0.9 * side as f32 / (high.x - low.x).max(high.y - low.y);
        let smooth = mesh.corner_normals(40f32.to_radians());
        let mut heights = vec![f32::NEG_INFINITY; side * side];
        let mut normals = vec![Vec3::ZERO; side * side];
        let half = side as f32 / 2.0;
        for (triangle, corners) in mesh.triangles().iter().enumerate() {
            // In pixels, y down.
            let [a, b, c] = corners.map(|corner| {
                let place = (mesh.positions()[corner as usize] - middle) * scale;
                Vec3::new(half + place.x - 0.5, half - place.y - 0.5, place.z)
            });
            let area = (b - a).truncate().perp_dot((c - a).truncate());
            if area == 0.0 {
                continue;
            }
            let [left, right] = [a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x)];
            let [top, bottom] = [a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y)];
            for y in top.ceil().max(0.0) as usize..=(bottom.floor().max(0.0) as usize).min(side - 1)
            {
                for x in
                    left.ceil().max(0.0) as usize..=(right.floor().max(0.0) as usize).min(side - 1)
                {
                    let at = Vec3::new(x as f32, y as f32, 0.0);
                    let share = |one: Vec3, other: Vec3| {
                        (one - at).truncate().perp_dot((other - at).truncate()) / area
                    };
                    let shares = [share(b, c), share(c, a), share(a, b)];
                    if shares.iter().any(|&share| share < 0.0) {
                        continue;
                    }
                    let z = shares[0] * a.z + shares[1] * b.z + shares[2] * c.z;
                    let pixel = y * side + x;
                    if z > heights[pixel] {
                        heights[pixel] = z;
                        let corners = smooth.corners[triangle];
                        normals[pixel] = (0..3)
                            .map(|k| smooth.normals[corners[k] as usize] * shares[k])
                            .sum();
                    }
                }
            }
        }
        let inside = heights.iter().map(|height| height.is_finite()).collect();
        let normals = normals.into_iter().map(|n| {
            if n.z < 0.0 {
                n * Vec3::new(1.0, 1.0, -1.0)
            } else {
                n
            }
        });
        Self {
            side,
            mask: Mask::new(side, side, inside),
            normals: NormalMap::new(side, side, normals.collect()),
            heights,
        }
    }

    /// Share of the neighbouring pixels between which the true height differs by more than four pixels.
    fn steps(&self) -> f32 {
        let inside = self.mask.inside();
        let pairs = self
            .mask
            .pixels()
            .into_iter()
            .filter(|&pixel| (pixel + 1) % self.side != 0 && inside[pixel + 1]);
        let jumps: Vec<bool> = pairs
            .map(|pixel| (self.heights[pixel] - self.heights[pixel + 1]).abs() > 4.0)
            .collect();
        jumps.iter().filter(|&&jump| jump).count() as f32 / jumps.len().max(1) as f32
    }

    /// Median and root mean square of the error, in percent of nine tenths of the picture.
    fn errors(&self, heights: &[f32]) -> [f32; 2] {
        let mut left = self.mask.clone();
        let mut errors = Vec::new();
        while left.count() > 0 {
            let part = left.without_small_parts(1.0);
            let pixels = part.pixels();
            let mut off: Vec<f32> = pixels
                .iter()
                .map(|&p| heights[p] - self.heights[p])
                .collect();
            let middle = off.len() / 2;
            let median = *off.select_nth_unstable_by(middle, f32::total_cmp).1;
            errors.extend(off.iter().map(|off| (off - median).abs()));
            let rest = left.inside().iter().zip(part.inside());
            left = Mask::new(self.side, self.side, rest.map(|(&a, &b)| a && !b).collect());
        }
        let percent = 100.0 / (0.9 * self.side as f32);
        let squares: f32 = errors.iter().map(|error| error * error).sum();
        let rms = (squares / errors.len() as f32).sqrt();
        let middle = errors.len() / 2;
        let median = *errors.select_nth_unstable_by(middle, f32::total_cmp).1;
        [median * percent, rms * percent]
    }
}
