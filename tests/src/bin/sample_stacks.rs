//! Renders the stacks that the page offers to try: `sample_stacks www/public/samples`, from the top of the
//! project. Their titles and descriptions stand in `samples.json` there.

use normalight_io::{mask_png, photograph_png, write_files};
use normalight_synth::{BitDepth, Framing, Renderer, Sample, SceneRecipe};
use std::error::Error;
use std::path::Path;

const IMAGES: usize = 16;
const SIDE: usize = 192;

/// Names, and which of their recipe's objects were found the most beautiful.
const SAMPLES: [(&str, u64); 3] = [("statue", 16), ("relief", 52), ("glossy", 3)];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("usage: sample_stacks FOLDER")?;
    for (name, number) in SAMPLES {
        let file = format!("models/recipes/sample-{name}.toml");
        let text = std::fs::read_to_string(&file).map_err(|error| format!("{file}: {error}"))?;
        let recipe = SceneRecipe::from_toml(Path::new(&file), &text)?;
        let sample = Renderer::new(recipe)?.sample(number, IMAGES, SIDE, Framing::WholeObject);
        write(&Path::new(&folder).join(name), &sample)?;
    }
    Ok(())
}

fn write(folder: &Path, sample: &Sample) -> Result<(), Box<dyn Error>> {
    let lines = |row: fn(&normalight_core::Light) -> [f32; 3]| {
        let rows = sample.lights.iter().map(|light| {
            let [x, y, z] = row(light);
            format!("{x:.6} {y:.6} {z:.6}\n")
        });
        rows.collect::<String>().into_bytes()
    };
    let mut files = vec![
        ("mask.png".to_owned(), mask_png(&sample.to_mask())?),
        (
            "light_directions.txt".to_owned(),
            lines(|light| light.direction.to_array()),
        ),
        (
            "light_intensities.txt".to_owned(),
            lines(|light| light.intensity),
        ),
    ];
    for image in sample.to_stack_images(BitDepth::Eight) {
        files.push((image.name.clone(), photograph_png(&image)?));
    }
    Ok(write_files(folder, &files)?)
}
