use super::measured::{Geometry, Measured};
use super::surfaces::Surfaces;
use crate::lanes::{LANES, Lanes, lanes, lanes_mut, vectorised};
use crate::lighting::Lamp;
use crate::scene::Points;
use std::f32::consts::PI;

/// Adds the light that points send to the camera from one lamp of intensity 1.
///
/// `lit`: share of the lamp each point sees, padded; `planes`: red, green and blue, padded.
pub(crate) fn shade(
    points: &Points,
    surfaces: &Surfaces,
    lamp: &Lamp,
    lit: &[f32],
    planes: &mut [Vec<f32>; 3],
) {
    vectorised(
        #[inline(always)]
        || {
            for start in (0..lit.len()).step_by(LANES) {
                let lit = lanes(lit, start);
                let setting = Setting::new(points, lamp, start);
                if !setting.any_lit(lit) {
                    continue;
                }
                let mut light = diffuse(surfaces, &setting, start);
                if surfaces.shiny {
                    add_highlights(&mut light, points, surfaces, &setting, start);
                }
                for layer in &surfaces.measured {
                    add_measured(&mut light, layer, points, &setting, start);
                }
                for (plane, light) in planes.iter_mut().zip(&light) {
                    let plane = lanes_mut(plane, start);
                    for lane in 0..LANES {
                        plane[lane] += light[lane] * (lit[lane] * setting.strength[lane]);
                    }
                }
            }
        },
    );
}

/// How lamp, surface and camera stand to each other.
struct Setting {
    lamp: [Lanes; 3],
    half: [Lanes; 3],
    /// Light that arrives, relative to the lamp's intensity.
    strength: Lanes,
    /// Cosines, the first two zero or more; `n`ormal, `l`amp, `v`iew, `h`alf vector.
    n_l: Lanes,
    n_v: Lanes,
    n_h: Lanes,
    l_h: Lanes,
    l_v: Lanes,
}

impl Setting {
    #[inline(always)]
    fn new(points: &Points, lamp: &Lamp, start: usize) -> Self {
        let (direction, strength) = lamp.seen_from(points, start);
        let normal = three(&points.normal, start);
        let view = three(&points.to_camera, start);
        let mut half = [[0.0; LANES]; 3];
        for lane in 0..LANES {
            let sum: [f32; 3] =
                std::array::from_fn(|axis| direction[axis][lane] + view[axis][lane]);
            let square = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
            let inverse = 1.0 / square.max(1e-12).sqrt();
            for axis in 0..3 {
                half[axis][lane] = sum[axis] * inverse;
            }
        }
        Self {
            n_l: positive(dot(normal, [&direction[0], &direction[1], &direction[2]])),
            n_v: positive(dot(normal, view)),
            n_h: dot(normal, [&half[0], &half[1], &half[2]]),
            l_h: dot([&half[0], &half[1], &half[2]], view),
            l_v: dot([&direction[0], &direction[1], &direction[2]], view),
            lamp: direction,
            half,
            strength,
        }
    }

    #[inline(always)]
    fn any_lit(&self, lit: &Lanes) -> bool {
        let mut most = 0.0;
        for (lit, cosine) in lit.iter().zip(&self.n_l) {
            most = max(lit * cosine, most);
        }
        most > 0.0
    }
}

/// Lambert's law, and for rough facets the qualitative model of Oren & Nayar (1994): their
/// `cos(phi) sin(alpha) tan(beta)` is `(l.v - n.l n.v) / max(n.l, n.v)`. Sheen is a velvet-like rim.
#[inline(always)]
fn diffuse(surfaces: &Surfaces, setting: &Setting, start: usize) -> [Lanes; 3] {
    let level = lanes(&surfaces.facets[0], start);
    let slope = lanes(&surfaces.facets[1], start);
    let sheen = lanes(&surfaces.sheen, start);
    let albedo = three(&surfaces.albedo, start);
    let mut light = [[0.0; LANES]; 3];
    for lane in 0..LANES {
        let (n_l, n_v) = (setting.n_l[lane], setting.n_v[lane]);
        let azimuth = max(setting.l_v[lane] - n_l * n_v, 0.0) / max(max(n_l, n_v), 1e-6);
        let factor = (level[lane] + slope[lane] * azimuth) * n_l;
        let rim = 1.0 - n_v;
        let velvet = sheen[lane] * (rim * rim * rim) * n_l;
        for channel in 0..3 {
            light[channel][lane] = albedo[channel][lane] * factor + velvet;
        }
    }
    light
}

/// Two lobes of GGX facets (Walter et al. 2007), the narrow one anisotropic (Burley 2012), with the
/// height-correlated masking of Heitz (2014) and Schlick's Fresnel term (1994).
#[inline(always)]
fn add_highlights(
    light: &mut [Lanes; 3],
    points: &Points,
    surfaces: &Surfaces,
    setting: &Setting,
    start: usize,
) {
    let normal = three(&points.normal, start);
    let view = three(&points.to_camera, start);
    let tangent = three(&surfaces.tangent, start);
    let f0 = three(&surfaces.f0, start);
    let (along, across) = (
        lanes(&surfaces.alphas[0], start),
        lanes(&surfaces.alphas[1], start),
    );
    let wide = lanes(&surfaces.wide_alpha, start);
    let (narrow_weight, wide_weight) = (
        lanes(&surfaces.weights[0], start),
        lanes(&surfaces.weights[1], start),
    );
    for lane in 0..LANES {
        let n = [normal[0][lane], normal[1][lane], normal[2][lane]];
        let t = [tangent[0][lane], tangent[1][lane], tangent[2][lane]];
        let b = [
            n[1] * t[2] - n[2] * t[1],
            n[2] * t[0] - n[0] * t[2],
            n[0] * t[1] - n[1] * t[0],
        ];
        let (mut t_h, mut b_h, mut t_l, mut b_l, mut t_v, mut b_v) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        for axis in 0..3 {
            let (h, l, v) = (
                setting.half[axis][lane],
                setting.lamp[axis][lane],
                view[axis][lane],
            );
            t_h += t[axis] * h;
            b_h += b[axis] * h;
            t_l += t[axis] * l;
            b_l += b[axis] * l;
            t_v += t[axis] * v;
            b_v += b[axis] * v;
        }
        let (n_l, n_v, n_h) = (setting.n_l[lane], setting.n_v[lane], setting.n_h[lane]);
        let (x, y) = (along[lane], across[lane]);
        let stretched = (t_h / x) * (t_h / x) + (b_h / y) * (b_h / y) + n_h * n_h;
        let density = 1.0 / (PI * x * y * stretched * stretched);
        let root = |t: f32, b: f32, n: f32| ((x * t) * (x * t) + (y * b) * (y * b) + n * n).sqrt();
        let masking = n_l * root(t_v, b_v, n_v) + n_v * root(t_l, b_l, n_l);
        let narrow = narrow_weight[lane] * density * 0.5 / max(masking, 1e-6);

        let square = wide[lane] * wide[lane];
        let spread = n_h * n_h * (square - 1.0) + 1.0;
        let density = square / (PI * spread * spread);
        let root = |n: f32| (square + (1.0 - square) * n * n).sqrt();
        let masking = n_l * root(n_v) + n_v * root(n_l);
        let wide = wide_weight[lane] * density * 0.5 / max(masking, 1e-6);

        let seen = if n_v > 0.0 { n_l } else { 0.0 };
        let highlight = PI * seen * (narrow + wide);
        let away = max(1.0 - setting.l_h[lane], 0.0);
        let fresnel = (away * away) * (away * away) * away;
        for channel in 0..3 {
            let f0 = f0[channel][lane];
            light[channel][lane] += (f0 + (1.0 - f0) * fresnel) * highlight;
        }
    }
}

#[inline(always)]
fn add_measured(
    light: &mut [Lanes; 3],
    (layer, tint): &(Measured, [Vec<f32>; 3]),
    points: &Points,
    setting: &Setting,
    start: usize,
) {
    let tint = three(tint, start);
    let normal = three(&points.normal, start);
    let mut side = [0.0; LANES];
    for lane in 0..LANES {
        let n = [normal[0][lane], normal[1][lane], normal[2][lane]];
        let h: [f32; 3] = std::array::from_fn(|axis| setting.half[axis][lane]);
        let l: [f32; 3] = std::array::from_fn(|axis| setting.lamp[axis][lane]);
        side[lane] = l[0] * (n[1] * h[2] - n[2] * h[1])
            + l[1] * (n[2] * h[0] - n[0] * h[2])
            + l[2] * (n[0] * h[1] - n[1] * h[0]);
    }
    let values = layer.reflectance(&Geometry {
        to_lamp: setting.n_l,
        to_half: setting.n_h,
        lamp_to_half: setting.l_h,
        side,
    });
    for channel in 0..3 {
        for lane in 0..LANES {
            let value = tint[channel][lane] * values[channel][lane];
            light[channel][lane] += value * (PI * setting.n_l[lane]);
        }
    }
}

#[inline(always)]
fn three(planes: &[Vec<f32>; 3], start: usize) -> [&Lanes; 3] {
    [
        lanes(&planes[0], start),
        lanes(&planes[1], start),
        lanes(&planes[2], start),
    ]
}

#[inline(always)]
fn dot(a: [&Lanes; 3], b: [&Lanes; 3]) -> Lanes {
    let mut result = [0.0; LANES];
    for lane in 0..LANES {
        result[lane] = a[0][lane] * b[0][lane] + a[1][lane] * b[1][lane] + a[2][lane] * b[2][lane];
    }
    result
}

#[inline(always)]
fn positive(mut values: Lanes) -> Lanes {
    for value in &mut values {
        *value = max(*value, 0.0);
    }
    values
}

/// Without the library's care for NaN, which takes more instructions.
#[inline(always)]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests;
