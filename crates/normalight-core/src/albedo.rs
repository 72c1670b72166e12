use crate::{CoreError, ImageStack, Light, Mask, NormalMap};

/// Shading below this carries more noise than signal.
pub(crate) const MIN_SHADING: f32 = 0.1;

/// Pixels looked at together: bounds the memory, whatever the size of the stack.
const TILE: usize = 4096;

/// Quantile of intensity / shading over the images that counts as albedo; below the median, because highlights only
/// ever add light.
pub(crate) const ALBEDO_QUANTILE: f32 = 0.4;

/// Albedo of every pixel as linear RGB planes, zero outside the mask.
///
/// Per pixel and channel the 0.4-quantile over the images of value / (intensity * shading), the
/// same robust albedo that [`refit_lights`](crate::refit_lights) uses; defined up to one scale.
///
/// # Shapes
/// `[3, height, width]`, row-major.
///
/// # Errors
/// [`CoreError::LightCount`] or [`CoreError::MapSize`].
pub fn albedo_map(
    stack: &ImageStack,
    mask: &Mask,
    normals: &NormalMap,
    lights: &[Light],
) -> Result<Vec<f32>, CoreError> {
    check(stack, mask, normals, lights)?;
    let pixels = thinned(mask, usize::MAX);
    let albedo = albedo_of(stack, normals, lights, &pixels, ALBEDO_QUANTILE);
    let area = stack.width() * stack.height();
    let mut planes = vec![0.0; 3 * area];
    for (&pixel, value) in pixels.iter().zip(albedo) {
        for (channel, value) in value.into_iter().enumerate() {
            planes[channel * area + pixel] = value;
        }
    }
    Ok(planes)
}

/// Checks that normals, mask and lights are those of the stack.
pub(crate) fn check(
    stack: &ImageStack,
    mask: &Mask,
    normals: &NormalMap,
    lights: &[Light],
) -> Result<(), CoreError> {
    if lights.len() != stack.len() {
        return Err(CoreError::LightCount {
            found: lights.len(),
            expected: stack.len(),
        });
    }
    for (width, height) in [
        (normals.width(), normals.height()),
        (mask.width(), mask.height()),
    ] {
        if (width, height) != (stack.width(), stack.height()) {
            return Err(CoreError::MapSize {
                found_width: width,
                found_height: height,
                expected_width: stack.width(),
                expected_height: stack.height(),
            });
        }
    }
    Ok(())
}

/// Positions of the mask's pixels, evenly thinned to at most `most`.
pub(crate) fn thinned(mask: &Mask, most: usize) -> Vec<usize> {
    let all = mask.inside().iter().enumerate();
    let pixels: Vec<usize> = all
        .filter_map(|(pixel, &inside)| inside.then_some(pixel))
        .collect();
    if pixels.len() <= most {
        return pixels;
    }
    (0..most).map(|k| pixels[k * pixels.len() / most]).collect()
}

/// RGB albedo at some pixels, tile by tile.
pub(crate) fn albedo_of(
    stack: &ImageStack,
    normals: &NormalMap,
    lights: &[Light],
    pixels: &[usize],
    quantile: f32,
) -> Vec<[f32; 3]> {
    let mut albedo = Vec::with_capacity(pixels.len());
    let mut values = vec![[0.0; 3]; TILE.min(pixels.len())];
    let mut ratios: Vec<[Vec<f32>; 3]> = vec![Default::default(); values.len()];
    for tile in pixels.chunks(TILE) {
        for ratio in ratios.iter_mut().flatten() {
            ratio.clear();
        }
        for (image, light) in lights.iter().enumerate() {
            let values = &mut values[..tile.len()];
            stack.linear_pixels(image, tile, values);
            for ((&pixel, value), ratio) in tile.iter().zip(values).zip(&mut ratios) {
                let shading = normals.normals()[pixel].dot(light.direction);
                if shading <= MIN_SHADING {
                    continue;
                }
                for channel in 0..3 {
                    let unit = light.intensity[channel] * shading;
                    ratio[channel].push(value[channel] / unit.max(f32::MIN_POSITIVE));
                }
            }
        }
        for ratio in &mut ratios[..tile.len()] {
            albedo.push(std::array::from_fn(|channel| {
                quantile_of(&mut ratio[channel], quantile)
            }));
        }
    }
    albedo
}

/// Quantile by selection; 0 for no values.
pub(crate) fn quantile_of(values: &mut [f32], quantile: f32) -> f32 {
    if values.is_empty() {
        return 0.0;
    }
    let rank = ((values.len() - 1) as f32 * quantile).round() as usize;
    *values.select_nth_unstable_by(rank, f32::total_cmp).1
}
