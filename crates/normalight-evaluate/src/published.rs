//! Published errors on DiLiGenT, to stand beside what is measured.

/// The objects of DiLiGenT in the order of published tables.
pub const DILIGENT: [&str; 10] = [
    "ball", "cat", "pot1", "bear", "pot2", "buddha", "goblet", "reading", "cow", "harvest",
];

/// A published method on DiLiGenT, all 96 photographs of each object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Published {
    /// Its name, as in the field.
    pub name: &'static str,
    /// Who published it and where the figures stand.
    pub source: &'static str,
    /// Millions of parameters, of networks.
    pub million_parameters: Option<f64>,
    /// Mean errors of the normals of each of [`DILIGENT`], in degrees.
    pub normals: Option<[f64; 10]>,
    /// Mean errors of the light directions of each of [`DILIGENT`], in degrees.
    pub lights: Option<[f64; 10]>,
    /// Means over the ten objects, where only they are published: of the light directions, in degrees, and of the intensities.
    pub light_means: Option<[f64; 2]>,
}

/// Where most of the figures stand: tables 1 and 2 of the paper that Normalight implements.
const PAPER: &str = "Sarno, Kumar, Kaya, Huang, Ferrari, Van Gool: Neural Architecture Search for Efficient Uncalibrated Deep Photometric Stereo, WACV 2022";

/// Methods that are not told the lights. All figures but those of GCNet as the paper lists them.
pub const PUBLISHED: [Published; 7] = [
    Published {
        name: "Papadhimitri & Favaro (classical)",
        source: "A closed-form, consistent and robust solution to uncalibrated photometric stereo via local diffuse reflectance maxima, IJCV 2014",
        million_parameters: None,
        normals: Some([
            4.77, 9.54, 9.51, 9.07, 15.90, 14.92, 29.93, 24.18, 19.53, 29.21,
        ]),
        lights: None,
        light_means: None,
    },
    Published {
        name: "UPS-FCN",
        source: "Chen, Han, Wong: PS-FCN, ECCV 2018",
        million_parameters: Some(6.1),
        normals: Some([
            3.96, 12.16, 11.13, 7.19, 11.11, 13.06, 18.07, 20.46, 11.84, 27.22,
        ]),
        lights: None,
        light_means: None,
    },
    Published {
        name: "SDPS-Net",
        source: "Chen, Han, Shi, Matsushita, Wong: Self-calibrating Deep Photometric Stereo Networks, CVPR 2019",
        million_parameters: Some(6.6),
        normals: Some([
            2.77, 8.06, 8.14, 6.89, 7.50, 8.97, 11.91, 14.90, 8.48, 17.43,
        ]),
        lights: None,
        light_means: Some([4.92, 0.068]),
    },
    Published {
        name: "GCNet + PS-FCN",
        source: "Chen, Waechter, Shi, Wong, Matsushita: What is Learned in Deep Uncalibrated Photometric Stereo?, ECCV 2020",
        million_parameters: Some(6.8),
        normals: Some([2.5, 7.9, 7.2, 5.6, 7.1, 8.6, 9.6, 14.9, 7.8, 16.2]),
        lights: None,
        light_means: Some([3.32, 0.052]),
    },
    Published {
        name: "Kaya et al.",
        source: "Kaya, Kumar, Oliveira, Ferrari, Van Gool: Uncalibrated Neural Inverse Rendering for Photometric Stereo of General Surfaces, CVPR 2021",
        million_parameters: Some(8.1),
        normals: Some([
            3.78, 7.91, 8.75, 5.96, 10.17, 13.14, 11.94, 18.22, 10.85, 25.49,
        ]),
        lights: None,
        light_means: None,
    },
    Published {
        name: "The paper, no auxiliary tower",
        source: PAPER,
        million_parameters: Some(4.4),
        normals: Some([
            4.86, 9.79, 9.98, 4.97, 8.95, 10.29, 9.46, 15.59, 8.06, 18.20,
        ]),
        lights: None,
        light_means: None,
    },
    Published {
        name: "The paper",
        source: PAPER,
        million_parameters: Some(4.4),
        normals: Some([
            3.46, 8.94, 7.76, 5.48, 7.10, 10.00, 9.78, 15.02, 6.04, 17.97,
        ]),
        lights: Some([3.27, 8.57, 3.22, 4.74, 4.29, 5.46, 8.34, 6.15, 3.74, 8.77]),
        light_means: Some([5.66, 0.096]),
    },
];

/// The paper's mean errors over all ten objects by number of photographs, read off its figure: photographs, degrees of the
/// lights, degrees of the normals.
pub const PAPER_BY_IMAGES: [(usize, f64, f64); 7] = [
    (2, 34.0, 34.0),
    (4, 21.0, 28.0),
    (8, 14.0, 19.0),
    (16, 13.0, 16.5),
    (32, 9.6, 12.7),
    (64, 7.4, 10.4),
    (96, 5.6, 9.15),
];

impl Published {
    /// The figure of one object, among `values` of this method.
    pub fn of(values: Option<[f64; 10]>, object: &str) -> Option<f64> {
        let place = DILIGENT.iter().position(|name| *name == object)?;
        Some(values?[place])
    }

    /// The mean of `values` over some objects; `None` when one of them has no figure.
    pub fn mean<'a>(
        values: Option<[f64; 10]>,
        objects: impl IntoIterator<Item = &'a str>,
    ) -> Option<f64> {
        let figures: Option<Vec<f64>> = objects
            .into_iter()
            .map(|object| Self::of(values, object))
            .collect();
        let figures = figures.filter(|figures| !figures.is_empty())?;
        Some(figures.iter().sum::<f64>() / figures.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published means of all ten objects, in the order of the methods.
    const MEANS: [f64; 7] = [16.66, 13.62, 9.51, 8.70, 11.62, 9.98, 9.15];

    #[test]
    fn objects_and_their_published_mean_agree() {
        for (published, expected) in PUBLISHED.iter().zip(MEANS) {
            let mean = Published::mean(published.normals, DILIGENT).unwrap();
            let name = published.name;
            assert!((mean - expected).abs() < 0.05, "{name}: {mean}, {expected}");
        }
        let paper = PUBLISHED.last().unwrap();
        let lights = Published::mean(paper.lights, DILIGENT).unwrap();
        assert!((lights - paper.light_means.unwrap()[0]).abs() < 0.05);
    }

    #[test]
    fn other_objects_have_no_figure() {
        let normals = PUBLISHED[2].normals;
        assert_eq!(Published::of(normals, "egg"), None);
        assert_eq!(Published::mean(normals, ["ball", "egg"]), None);
        assert_eq!(Published::mean(normals, []), None);
        let two = Published::mean(normals, ["ball", "cow"]).unwrap();
        assert!((two - (2.77 + 8.48) / 2.0).abs() < 1e-9);
    }
}
