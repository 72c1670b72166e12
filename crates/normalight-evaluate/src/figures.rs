use crate::Reliability;
use serde::{Deserialize, Serialize};

/// Errors of the normals of one object, or their means over several.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct NormalFigures {
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
}

/// Errors and time of one object, or their means over several.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Errors of the normals; `None` where the true ones are not known.
    #[serde(flatten)]
    pub normals: Option<NormalFigures>,
    /// Mean angle between estimated and true light directions, in degrees; `None` when the true lights were given, or
    /// are not known.
    pub light_degrees: Option<f64>,
    /// Scale-invariant relative error of the intensities; `None` where there is no error of the directions.
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

impl NormalFigures {
    fn mean(all: &[Self]) -> Self {
        let mean = |value: fn(&Self) -> f64| all.iter().map(value).sum::<f64>() / all.len() as f64;
        Self {
            normal_degrees: mean(|figures| figures.normal_degrees),
            normal_median_degrees: mean(|figures| figures.normal_median_degrees),
            under_11_25: mean(|figures| figures.under_11_25),
            under_22_5: mean(|figures| figures.under_22_5),
            under_30: mean(|figures| figures.under_30),
        }
    }
}

impl Figures {
    /// Mean error of the normals in degrees.
    pub fn normal_degrees(&self) -> Option<f64> {
        self.normals.map(|normals| normals.normal_degrees)
    }

    /// The mean over several, each counting the same; `None` without any. What one of them lacks, the mean lacks too: one
    /// over the others would be another benchmark's.
    pub fn mean<'a>(all: impl IntoIterator<Item = &'a Self>) -> Option<Self> {
        let all: Vec<&Self> = all.into_iter().collect();
        if all.is_empty() {
            return None;
        }
        let seconds: f64 = all.iter().map(|figures| figures.seconds).sum();
        let normals: Option<Vec<NormalFigures>> =
            all.iter().map(|figures| figures.normals).collect();
        let known = |value: fn(&Self) -> Option<f64>| {
            let values: Option<Vec<f64>> = all.iter().map(|figures| value(figures)).collect();
            values.map(|values| values.iter().sum::<f64>() / values.len() as f64)
        };
        Some(Self {
            normals: normals.map(|normals| NormalFigures::mean(&normals)),
            light_degrees: known(|figures| figures.light_degrees),
            intensity_error: known(|figures| figures.intensity_error),
            seconds: seconds / all.len() as f64,
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
                normals: Some(NormalFigures {
                    normal_degrees,
                    normal_median_degrees: normal_degrees / 2.0,
                    under_11_25: 0.5,
                    under_22_5: 0.75,
                    under_30: 1.0,
                }),
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
        let mean_of = mean(&two).unwrap();
        let normals = mean_of.normals.unwrap();
        assert_eq!(
            (normals.normal_degrees, mean_of.light_degrees),
            (6.0, Some(2.5))
        );
        assert_eq!(normals.normal_median_degrees, 3.0);
        assert_eq!((normals.under_22_5, mean_of.seconds), (0.75, 2.0));
        // A mean of the others would be another benchmark's.
        let [one, mut other] = two;
        other.figures.normals = None;
        let mean_of = mean(&[one, other]).unwrap();
        assert_eq!((mean_of.normals, mean_of.light_degrees), (None, Some(2.5)));
    }

    #[test]
    fn figures_stand_beside_the_name() {
        let json = serde_json::to_value(object(4.0, None)).unwrap();
        assert_eq!(json["name"], "egg");
        assert_eq!(json["normal_degrees"], 4.0);
        assert!(json["light_degrees"].is_null());
        let read: ObjectFigures = serde_json::from_value(json.clone()).unwrap();
        assert_eq!(read, object(4.0, None));
        let mut withheld = read;
        withheld.figures.normals = None;
        let json = serde_json::to_value(&withheld).unwrap();
        assert!(json.get("normal_degrees").is_none());
        assert_eq!(
            serde_json::from_value::<ObjectFigures>(json).unwrap(),
            withheld
        );
    }
}
