//! Errors of the classical methods on DiLiGenT objects, in degrees:
//! `cargo run --release -p normalight-io --example classical -- FOLDER [IMAGES]`, an object or a benchmark.
use normalight_core::{
    NormalMap, intensity_error, least_squares_normals, mean_light_error, normal_error,
    robust_normals, uncalibrated_factorisation,
};
use normalight_io::{list_diligent_objects, read_diligent_object};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("expected: FOLDER [IMAGES]")?;
    let images = arguments.next().map(|count| count.parse()).transpose()?;
    println!("object, least squares, robust, uncalibrated: normals, lights, intensities");
    for path in list_diligent_objects(Path::new(&folder))? {
        let object = read_diligent_object(&path, images)?;
        let (stack, mask) = (&object.input.stack, &object.input.mask);
        let degrees = |normals: &NormalMap| {
            normal_error(normals, &object.normals, mask).map(|error| error.mean.to_degrees())
        };
        let squares = degrees(&least_squares_normals(stack, mask, &object.lights)?.0)?;
        let robust = degrees(&robust_normals(stack, mask, &object.lights)?.0)?;
        let found = uncalibrated_factorisation(stack, mask)?;
        let normals = degrees(&found.normals)?;
        let lights = mean_light_error(&found.lights, &object.lights)?.to_degrees();
        let intensities = intensity_error(&found.lights, &object.lights)?;
        println!(
            "{}, {squares:.2}, {robust:.2}, {normals:.2}, {lights:.2}, {intensities:.3}",
            object.name
        );
    }
    Ok(())
}
