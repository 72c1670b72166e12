use anyhow::{Result, bail};
use normalight_core::StackStatistics;
use normalight_io::{DiligentObject, list_diligent_objects, read_diligent_object};
use normalight_synth::Sample;
use std::path::Path;

/// Heads of the columns and how their figures are shown: as shares or with so many digits.
const COLUMNS: [(&str, Option<usize>); 8] = [
    ("cover", None),
    ("mean", Some(3)),
    ("black", None),
    ("saturated", None),
    ("contrast", Some(2)),
    ("entropy", Some(2)),
    ("lights", Some(1)),
    ("furthest", Some(1)),
];

const LEGEND: &str = "\
cover: share of the frame that is object; mean: of its values; black, saturated: share of its samples that are 0 or
full in 8 bits; contrast: brightest sample of a pixel over its mean; entropy: of the normals, in bits; lights,
furthest: mean and largest angle between lights and viewing axis in degrees\n";

/// What rendered stacks look like in numbers.
#[derive(Default)]
pub(crate) struct Statistics(Vec<[f64; 8]>);

impl Statistics {
    pub(crate) fn add(&mut self, sample: &Sample) -> Result<()> {
        let (stack, mask) = (sample.to_stack()?, sample.to_mask());
        let normals = sample.to_normal_map();
        let statistics = StackStatistics::new(&stack, &mask, &normals, &sample.lights)?;
        self.0.push(statistics.figures());
        Ok(())
    }

    /// A table: the rendered stacks' mean and the range of nine in ten, and the objects of a folder.
    pub(crate) fn to_text(&self, compare: Option<&Path>) -> Result<String> {
        let mut text = row("", &COLUMNS.map(|(name, _)| name.to_owned()));
        for (name, pick) in [("lowest 5 %", 0.05), ("median", 0.5), ("highest 5 %", 0.95)] {
            let figures = std::array::from_fn(|column| {
                let mut values: Vec<f64> = self.0.iter().map(|figures| figures[column]).collect();
                values.sort_by(f64::total_cmp);
                values[((values.len() - 1) as f64 * pick).round() as usize]
            });
            text += &row(name, &cells(&figures));
        }
        let count = self.0.len() as f64;
        let mean = std::array::from_fn(|k| self.0.iter().map(|f| f[k]).sum::<f64>() / count);
        text += &row(&format!("mean of {}", self.0.len()), &cells(&mean));
        if let Some(folder) = compare {
            text.push('\n');
            for folder in list_diligent_objects(folder)? {
                let object = read_diligent_object(&folder, None)?;
                let (Some(normals), Some(lights)) = (&object.normals, &object.lights) else {
                    bail!(
                        "{}: its true normals or lights are not known",
                        folder.display()
                    );
                };
                let DiligentObject { input, .. } = &object;
                let statistics = StackStatistics::new(&input.stack, &input.mask, normals, lights)?;
                text += &row(&object.name, &cells(&statistics.figures()));
            }
        }
        text.push('\n');
        text += LEGEND;
        Ok(text)
    }
}

fn cells(figures: &[f64; 8]) -> [String; 8] {
    std::array::from_fn(|column| match COLUMNS[column].1 {
        None => format!("{:.1} %", 100.0 * figures[column]),
        Some(digits) => format!("{:.digits$}", figures[column]),
    })
}

fn row(name: &str, cells: &[String; 8]) -> String {
    let cells: String = cells.iter().map(|cell| format!("  {cell:>9}")).collect();
    format!("{name:14}{cells}\n")
}
