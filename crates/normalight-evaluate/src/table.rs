use crate::{Disturbance, Figures, Method, NormalFigures, ObjectFigures, Photographs, Reliability};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;

/// What came of one object with one method and one choice of its photographs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// The object's name.
    pub object: String,
    /// The method.
    pub method: Method,
    /// The choice.
    #[serde(flatten)]
    pub photographs: Photographs,
    /// The errors, or why there are none.
    pub result: Result<ObjectFigures, String>,
}

/// The errors of all objects with one method and one number of photographs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    /// The method.
    pub method: Method,
    /// Photographs asked for; `None` for all.
    pub images: Option<usize>,
    /// What was done to them.
    pub disturbance: Option<Disturbance>,
    /// Number of random choices of photographs that the figures are means of; 0 for those spread over the series, or all.
    pub subsets: usize,
    /// Those that could be measured.
    pub objects: Vec<ObjectFigures>,
    /// The mean over them, each counting the same.
    pub mean: Option<Figures>,
    /// How the mean over the objects varies from one random choice to another.
    pub spread: Option<Spread>,
    /// Those that could not be measured.
    pub failures: Vec<Failure>,
}

/// Standard deviations over random choices of photographs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// Of the mean error of the normals, in degrees.
    pub normal_degrees: Option<f64>,
    /// Of the mean error of the lights, in degrees.
    pub light_degrees: Option<f64>,
}

/// An object that could not be evaluated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Failure {
    /// Its name.
    pub name: String,
    /// Why.
    pub reason: String,
}

impl Table {
    /// A table for each method and number of photographs, in the order in which they come.
    pub fn all(trials: &[Trial]) -> Vec<Self> {
        let key = |trial: &Trial| {
            let Photographs {
                images,
                disturbance,
                ..
            } = trial.photographs;
            (trial.method, images, disturbance)
        };
        let mut keys = Vec::new();
        for trial in trials {
            if !keys.contains(&key(trial)) {
                keys.push(key(trial));
            }
        }
        let of_key = |wanted| -> Vec<&Trial> {
            trials.iter().filter(|trial| key(trial) == wanted).collect()
        };
        keys.into_iter()
            .map(|key| Self::of(key, &of_key(key)))
            .collect()
    }

    fn of(
        (method, images, disturbance): (Method, Option<usize>, Option<Disturbance>),
        trials: &[&Trial],
    ) -> Self {
        let (mut names, mut subsets) = (Vec::new(), Vec::new());
        for trial in trials {
            if !names.contains(&&trial.object) {
                names.push(&trial.object);
            }
            if let Some(subset) = trial.photographs.subset.filter(|s| !subsets.contains(s)) {
                subsets.push(subset);
            }
        }
        let (mut objects, mut failures) = (Vec::new(), Vec::new());
        for name in names {
            let of_it = || trials.iter().filter(|trial| trial.object == *name);
            let failed = of_it().find_map(|trial| trial.result.as_ref().err());
            if let Some(reason) = failed {
                failures.push(Failure {
                    name: name.clone(),
                    reason: reason.clone(),
                });
                continue;
            }
            let measured: Vec<&ObjectFigures> =
                of_it().filter_map(|o| o.result.as_ref().ok()).collect();
            let figures = Figures::mean(measured.iter().map(|object| &object.figures));
            if let (Some(first), Some(figures)) = (measured.first(), figures) {
                objects.push(ObjectFigures {
                    figures,
                    reliability: Reliability::mean(measured.iter().map(|one| &one.reliability[..])),
                    ..(*first).clone()
                });
            }
        }
        let means: Vec<Figures> = subsets
            .iter()
            .filter_map(|subset| {
                let measured = |name: &String| objects.iter().any(|object| object.name == *name);
                let of_it = trials.iter().filter(|trial| {
                    trial.photographs.subset == Some(*subset) && measured(&trial.object)
                });
                Figures::mean(of_it.filter_map(|trial| Some(&trial.result.as_ref().ok()?.figures)))
            })
            .collect();
        Self {
            method,
            images,
            disturbance,
            subsets: subsets.len(),
            mean: Figures::mean(objects.iter().map(|object| &object.figures)),
            spread: (means.len() > 1).then(|| Spread::of(&means)),
            objects,
            failures,
        }
    }

    /// Errors that the estimates expect against those that were found, over all objects; empty where one expects none.
    pub fn reliability(&self) -> Vec<Reliability> {
        Reliability::mean(self.objects.iter().map(|object| &object.reliability[..]))
    }

    /// What it is of, in words.
    pub fn title(&self) -> String {
        let photographs = Photographs {
            images: self.images,
            subset: None,
            disturbance: self.disturbance,
        };
        match self.subsets {
            0 => photographs.words(),
            subsets => format!("{}, mean of {subsets} random choices", photographs.words()),
        }
    }

    /// The table as text, one line for each object and one for their mean.
    pub fn to_text(&self) -> String {
        let names = self.objects.iter().map(|object| object.name.as_str());
        let failed = self.failures.iter().map(|failure| failure.name.as_str());
        let width = names
            .chain(failed)
            .map(|name| name.chars().count())
            .fold(6, usize::max);
        let row = |name: &str, cells: &[String]| {
            let cells: String = cells.iter().map(|cell| format!("  {cell:>9}")).collect();
            format!("{name:width$}{cells}\n")
        };
        let mut text = row("object", &COLUMNS.map(str::to_owned));
        for object in &self.objects {
            let cells = cells(Some(object.images), &object.figures);
            text += &row(&object.name, &cells);
        }
        for failure in &self.failures {
            text += &format!("{:width$}  failed: {}\n", failure.name, failure.reason);
        }
        if let Some(mean) = &self.mean {
            text += &row("mean", &cells(None, mean));
        }
        if let Some(spread) = &self.spread {
            let parts = [
                ("normals", spread.normal_degrees),
                ("lights", spread.light_degrees),
            ];
            let known = parts
                .into_iter()
                .filter_map(|(what, deviation)| Some(format!("{what} {:.2}", deviation?)));
            let known: Vec<String> = known.collect();
            let _ = writeln!(
                text,
                "standard deviation over the choices: {}",
                known.join(", ")
            );
        }
        for object in self.objects.iter().filter(|o| o.without_truth > 0) {
            let _ = match object.figures.normals {
                Some(_) => writeln!(
                    text,
                    "{}: {} pixels without a true normal left out",
                    object.name, object.without_truth
                ),
                None => writeln!(text, "{}: its true normals are not known", object.name),
            };
        }
        text
    }
}

impl Spread {
    fn of(means: &[Figures]) -> Self {
        let deviation = |values: Vec<f64>| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
            (squares / (values.len() - 1) as f64).sqrt()
        };
        let normals: Option<Vec<f64>> = means.iter().map(Figures::normal_degrees).collect();
        let lights: Option<Vec<f64>> = means.iter().map(|figures| figures.light_degrees).collect();
        Self {
            normal_degrees: normals.map(deviation),
            light_degrees: lights.map(deviation),
        }
    }
}

/// Heads of the columns after the object's name.
pub(crate) const COLUMNS: [&str; 9] = [
    "images",
    "normals",
    "median",
    "<11.25",
    "<22.5",
    "<30",
    "lights",
    "intensity",
    "seconds",
];

/// The cells below [`COLUMNS`].
pub(crate) fn cells(images: Option<usize>, figures: &Figures) -> [String; 9] {
    let share = |share: f64| format!("{:.1} %", 100.0 * share);
    let normals =
        |words: &dyn Fn(NormalFigures) -> String| figures.normals.map_or("-".to_owned(), words);
    [
        images.map_or(String::new(), |images| images.to_string()),
        known(figures.normal_degrees(), 2),
        normals(&|normals| format!("{:.2}", normals.normal_median_degrees)),
        normals(&|normals| share(normals.under_11_25)),
        normals(&|normals| share(normals.under_22_5)),
        normals(&|normals| share(normals.under_30)),
        known(figures.light_degrees, 2),
        known(figures.intensity_error, 3),
        format!("{:.2}", figures.seconds),
    ]
}

/// A figure that may not be there.
pub(crate) fn known(value: Option<f64>, digits: usize) -> String {
    value.map_or("-".to_owned(), |value| format!("{value:.digits$}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trial(object: &str, images: Option<usize>, subset: Option<u64>, degrees: f64) -> Trial {
        let figures = Figures {
            normals: Some(NormalFigures {
                normal_degrees: degrees,
                normal_median_degrees: degrees,
                under_11_25: 0.5,
                under_22_5: 0.5,
                under_30: 1.0,
            }),
            light_degrees: Some(degrees / 2.0),
            intensity_error: Some(0.1),
            seconds: 1.0,
            multiply_adds: None,
            peak_memory: None,
        };
        Trial {
            object: object.to_owned(),
            method: Method::Uncalibrated,
            photographs: Photographs {
                images,
                subset,
                disturbance: None,
            },
            result: Ok(ObjectFigures {
                name: object.to_owned(),
                images: images.unwrap_or(96),
                pixels: 100,
                without_truth: 7,
                figures,
                reliability: Vec::new(),
            }),
        }
    }

    #[test]
    fn random_choices_are_averaged_and_spread() {
        let trials = [
            trial("egg", None, None, 4.0),
            trial("egg", Some(8), Some(0), 6.0),
            trial("egg", Some(8), Some(1), 10.0),
            trial("cup", Some(8), Some(0), 12.0),
            trial("cup", Some(8), Some(1), 20.0),
        ];
        let tables = Table::all(&trials);
        assert_eq!(tables.len(), 2);
        assert_eq!((tables[0].subsets, tables[0].spread), (0, None));
        let table = &tables[1];
        let degrees: Vec<f64> = table
            .objects
            .iter()
            .map(|o| o.figures.normal_degrees().unwrap())
            .collect();
        assert_eq!(degrees, [8.0, 16.0]);
        assert_eq!(table.mean.unwrap().normal_degrees(), Some(12.0));
        // Means over the objects: 9 and 15.
        let spread = table.spread.unwrap();
        assert!((spread.normal_degrees.unwrap() - 18.0_f64.sqrt()).abs() < 1e-9);
        assert!((spread.light_degrees.unwrap() - 18.0_f64.sqrt() / 2.0).abs() < 1e-9);
        let text = table.to_text();
        for part in ["egg", "16.00", "mean", "4.24", "egg: 7 pixels"] {
            assert!(text.contains(part), "{part} is missing in {text}");
        }
    }

    #[test]
    fn an_object_that_failed_once_is_not_averaged() {
        let mut failed = trial("cup", Some(8), Some(1), 20.0);
        failed.result = Err("too dark".to_owned());
        let trials = [
            trial("egg", Some(8), Some(0), 6.0),
            trial("cup", Some(8), Some(0), 9.0),
            failed,
        ];
        let table = &Table::all(&trials)[0];
        assert_eq!(table.objects.len(), 1);
        assert_eq!(table.failures[0].reason, "too dark");
        assert_eq!(table.mean.unwrap().normal_degrees(), Some(6.0));
        assert!(table.to_text().contains("failed: too dark"));
    }
}
