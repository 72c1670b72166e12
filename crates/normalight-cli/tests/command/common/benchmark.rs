//! The small stack with its truth, as DiLiGenT has it.
use super::{sample, write_stack};
use normalight_synth::Sample;
use std::path::Path;

/// One part of a MATLAB 5 file: type, size, content, padding to eight bytes.
fn element(kind: u32, content: &[u8]) -> Vec<u8> {
    let mut bytes = [kind.to_le_bytes(), (content.len() as u32).to_le_bytes()].concat();
    bytes.extend(content);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

/// A MATLAB 5 file with the true normals, columns first.
fn normals_mat(sample: &Sample) -> Vec<u8> {
    let side = sample.size;
    let places = (0..3 * side * side).map(|index| {
        let (axis, column, row) = (index / (side * side), index / side % side, index % side);
        f64::from(sample.normals[row * side + column][axis])
    });
    let values: Vec<u8> = places.flat_map(f64::to_le_bytes).collect();
    let size = [side as i32, side as i32, 3].map(i32::to_le_bytes).concat();
    let parts = [
        element(6, &[6, 0, 0, 0, 0, 0, 0, 0]),
        element(5, &size),
        element(1, b"Normal_gt"),
        element(9, &values),
    ];
    let mut file = vec![b' '; 124];
    file.extend([0x00, 0x01, b'I', b'M']);
    file.extend(element(14, &parts.concat()));
    file
}

/// Photographs with their truth, as DiLiGenT has them.
pub fn write_object(folder: &Path) {
    let sample = sample();
    write_stack(folder, &sample);
    let line = |values: [f32; 3]| values.map(|value| value.to_string()).join(" ");
    let directions: Vec<String> = sample
        .lights
        .iter()
        .map(|light| line(light.direction.to_array()))
        .collect();
    let intensities: Vec<String> = sample
        .lights
        .iter()
        .map(|light| line(light.intensity))
        .collect();
    std::fs::write(folder.join("light_directions.txt"), directions.join("\n")).unwrap();
    std::fs::write(folder.join("light_intensities.txt"), intensities.join("\n")).unwrap();
    std::fs::write(folder.join("Normal_gt.mat"), normals_mat(&sample)).unwrap();
}
