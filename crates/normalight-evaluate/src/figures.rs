use crate::Reliability;
use serde::{Deserialize, Serialize};

/// Errors and time of one object, or their means over several.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Mean angle between estimated and true normals, in degrees.
    pub normal_degrees: f64,
    /// Median of these angles, in degrees.
    pub normal_median_degrees: f64,
    /// Share of pixels, 0..1, whose normal is less than 11.25 degrees off.
    pub under_11_25: f64,
    /// Share of pixels under 22.5 degrees.
    pub under_22_5: f64,
    /// Share of pixels under 30 degrees.
    pub under_30: f64,
    /// Mean angle between estimated and true light directions, in degrees; `None` when the true lights were given.
    pub light_degrees: Option<f64>,
    /// Scale-invariant relative error of the intensities; `None` when the true lights were given.
    pub intensity_error: Option<f64>,
    /// Seconds of estimating, reading left out.
    pub seconds: f64,
    /// Multiply-adds of the networks; `None` without any.
    #[serde(default)]
    pub multiply_adds: Option<f64>,
    /// Most memory that the process held meanwhile, in bytes, program and photographs included; `None` where the system does
    /// not tell, or others worked beside.
    #[serde(default)]
    pub peak_memory: Option<f64>,
}

/// The figures of one object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ObjectFigures {
    /// The object.
    pub name: String,
    /// Number of images used.
    pub images: usize,
    /// Number of pixels compared.
    pub pixels: usize,
    /// Number of pixels of the object that were left out, since their true normal is not known.
    pub without_truth: usize,
    /// Its errors and time.
    #[serde(flatten)]
    pub figures: Figures,
    /// Errors that the estimate expects against those that were found; empty where it expects none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reliability: Vec<Reliability>,
}

impl Figures {
    /// The mean over several, each counting the same; `None` without any.
    pub fn mean<'a>(all: impl IntoIterator<Item = &'a Self>) -> Option<Self> {
        let all: Vec<&Self> = all.into_iter().collect();
        if all.is_empty() {
            return None;
        }
        let mean = |value: fn(&Self) -> f64| {
            all.iter().map(|figures| value(figures)).sum::<f64>() / all.len() as f64
        };
        let known = |value: fn(&Self) -> Option<f64>| {
            let values: Option<Vec<f64>> = all.iter().map(|figures| value(figures)).collect();
            values.map(|values| values.iter().sum::<f64>() / values.len() as f64)
        };
        Some(Self {
            normal_degrees: mean(|figures| figures.normal_degrees),
            normal_median_degrees: mean(|figures| figures.normal_median_degrees),
            under_11_25: mean(|figures| figures.under_11_25),
            under_22_5: mean(|figures| figures.under_22_5),
            under_30: mean(|figures| figures.under_30),
            light_degrees: known(|figures| figures.light_degrees),
            intensity_error: known(|figures| figures.intensity_error),
            seconds: mean(|figures| figures.seconds),
            multiply_adds: known(|figures| figures.multiply_adds),
            peak_memory: known(|figures| figures.peak_memory),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn object(normal_degrees: f64, light_degrees: Option<f64>) -> ObjectFigures {
        ObjectFigures {
            name: "egg".to_owned(),
            images: 8,
            pixels: 100,
            without_truth: 3,
            figures: Figures {
                normal_degrees,
                normal_median_degrees: normal_degrees / 2.0,
                under_11_25: 0.5,
                under_22_5: 0.75,
                under_30: 1.0,
                light_degrees,
                intensity_error: light_degrees.map(|_| 0.1),
                seconds: 2.0,
                multiply_adds: None,
                peak_memory: Some(1e9),
            },
            reliability: Vec::new(),
        }
    }

    #[test]
    fn every_object_counts_the_same() {
        let mean = |objects: &[ObjectFigures]| Figures::mean(objects.iter().map(|o| &o.figures));
        let two = [object(4.0, Some(1.0)), object(8.0, Some(4.0))];
        let given = mean(&[object(4.0, None)]).unwrap();
        assert_eq!((given.light_degrees, given.intensity_error), (None, None));
        assert_eq!(mean(&[]), None);
        let mean = mean(&two).unwrap();
        assert_eq!((mean.normal_degrees, mean.light_degrees), (6.0, Some(2.5)));
        assert_eq!(mean.normal_median_degrees, 3.0);
        assert_eq!((mean.under_22_5, mean.seconds), (0.75, 2.0));
    }

    #[test]
    fn figures_stand_beside_the_name() {
        let json = serde_json::to_value(object(4.0, None)).unwrap();
        assert_eq!(json["name"], "egg");
        assert_eq!(json["normal_degrees"], 4.0);
        assert!(json["light_degrees"].is_null());
    }
}
