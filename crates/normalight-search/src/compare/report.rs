//! What a comparison gives: `compare.json`, and a table for people.
use super::{Body, Entry, Equal, width};
use normalight_run::{RunState, Summary};
use normalight_train::{Network, TrainRecipe};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of the group of random genotypes.
const RANDOM: &str = "random";

/// The content of `compare.json`: how a comparison stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Whether everything is trained.
    pub state: RunState,
    /// Which network.
    pub network: Network,
    /// What is the same for all.
    pub equal: Equal,
    /// Multiply-adds for a stack of ten images that all come close to.
    pub multiply_adds: u64,
    /// SHA-256 of `recipe.toml`, the common schedule.
    pub recipe_sha256: String,
    /// In the order they were given.
    pub entries: Vec<EntryResult>,
    /// Entries that are one thing together.
    pub groups: Vec<Group>,
}

/// What kind of network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EntryKind {
    /// Cells of a genotype.
    Cells,
    /// The plain network.
    Plain,
}

/// One that is compared.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EntryResult {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: EntryKind,
    /// What its genotype says where it comes from.
    pub source: Option<String>,
    /// The group that it belongs to.
    pub group: Option<String>,
    /// Base width of its network.
    pub width: usize,
    /// Number of trainable weights, the auxiliary tower left out.
    pub parameters: usize,
    /// For a stack of ten images.
    pub multiply_adds: u64,
    /// Steps of each training.
    pub steps: usize,
    /// Seconds of a step, as measured beforehand; only where training times are equal.
    pub step_seconds: Option<f64>,
    /// Hours of a training, its validations included: the mean over the seeds.
    pub hours: Option<f64>,
    /// Every training that has ended.
    pub seeds: Vec<SeedResult>,
    /// Mean of the errors in degrees; nothing where one of them diverged.
    pub mean: Option<f64>,
    /// Sample standard deviation of the errors over the seeds, degrees.
    pub spread: Option<f64>,
    /// How often each operation stands in the genotype.
    pub operations: BTreeMap<String, usize>,
}

/// What one training gave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeedResult {
    /// Its seed.
    pub seed: u64,
    /// Best validation error in degrees; nothing when it diverged.
    pub degrees: Option<f32>,
    /// Step of the best validation.
    pub step: Option<usize>,
    /// Hours of training.
    pub hours: Option<f64>,
}

/// Entries that are one thing together, as random genotypes are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Group {
    /// What they have in common.
    pub name: String,
    /// Those that have a mean error.
    pub entries: usize,
    /// Mean of their mean errors, degrees.
    pub mean: f64,
    /// Sample standard deviation of their mean errors, degrees.
    pub spread: Option<f64>,
    /// Name of the best.
    pub best: String,
    /// Its mean error, degrees.
    pub best_mean: f64,
}

impl SeedResult {
    pub(super) fn new(seed: u64, summary: &Summary) -> Self {
        Self {
            seed,
            degrees: summary.best.as_ref().map(|best| best.degrees),
            step: summary.best.as_ref().map(|best| best.step),
            hours: Some(summary.hours),
        }
    }

    pub(super) fn diverged(seed: u64) -> Self {
        Self {
            seed,
            degrees: None,
            step: None,
            hours: None,
        }
    }
}

impl EntryResult {
    pub(super) fn new(entry: &Entry, recipe: &TrainRecipe) -> Self {
        let (kind, source) = match &entry.body {
            Body::Cells(genotypes) => (EntryKind::Cells, Some(genotypes.source.clone())),
            Body::Plain => (EntryKind::Plain, None),
        };
        Self {
            name: entry.name.clone(),
            kind,
            source,
            group: entry.random.then(|| RANDOM.to_owned()),
            width: recipe.network.width(),
            parameters: recipe.parameters(),
            multiply_adds: width::multiply_adds(recipe),
            steps: recipe.steps,
            step_seconds: None,
            hours: None,
            seeds: Vec::new(),
            mean: None,
            spread: None,
            operations: entry.operations(recipe.network.kind()),
        }
    }

    pub(super) fn add(&mut self, result: SeedResult) {
        self.seeds.push(result);
        let hours: Vec<f64> = self.seeds.iter().filter_map(|one| one.hours).collect();
        self.hours = mean(&hours);
        let errors = self.seeds.iter().map(|one| one.degrees.map(f64::from));
        let errors: Option<Vec<f64>> = errors.collect();
        self.mean = errors.as_deref().and_then(mean);
        self.spread = errors.as_deref().and_then(spread);
    }
}

impl Comparison {
    /// Brings the groups up to date.
    pub(super) fn summarise(&mut self) {
        let mut members = BTreeMap::<&str, Vec<(&str, f64)>>::new();
        for entry in &self.entries {
            if let (Some(group), Some(mean)) = (&entry.group, entry.mean) {
                members.entry(group).or_default().push((&entry.name, mean));
            }
        }
        let groups = members.into_iter().filter_map(|(name, members)| {
            let means: Vec<f64> = members.iter().map(|(_, mean)| *mean).collect();
            let (best, best_mean) = members.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
            Some(Group {
                name: name.to_owned(),
                entries: means.len(),
                mean: mean(&means)?,
                spread: spread(&means),
                best: (*best).to_owned(),
                best_mean: *best_mean,
            })
        });
        self.groups = groups.collect();
    }

    /// As a table, the best first, and a line for every group.
    pub fn to_text(&self) -> String {
        let mut entries: Vec<&EntryResult> = self.entries.iter().collect();
        // What has no error comes last.
        let key = |one: &EntryResult| one.mean.unwrap_or(f64::INFINITY);
        entries.sort_by(|a, b| key(a).total_cmp(&key(b)));
        let names = self.entries.iter().map(|one| one.name.chars().count());
        let column = names.fold(5, usize::max);
        let mut text = format!(
            "{:column$}   error  spread  seeds  width  parameters  multiply-adds   steps   hours  operations\n",
            "name"
        );
        for one in entries {
            let operations = one.operations.iter();
            let operations: Vec<_> = operations
                .map(|(operation, count)| format!("{count} {operation}"))
                .collect();
            let line = format!(
                "{:column$} {:>7} {:>7} {:6} {:6} {:11} {:12.2}M {:7} {:>7}  {}",
                one.name,
                number(one.mean, 2),
                number(one.spread, 2),
                one.seeds.len(),
                one.width,
                one.parameters,
                one.multiply_adds as f64 / 1e6,
                one.steps,
                number(one.hours, 3),
                operations.join(", ")
            );
            text += line.trim_end();
            text.push('\n');
        }
        for group in &self.groups {
            text += &format!(
                "\n{} of {} entries: mean {:.2}, spread {}, best {:.2} ({})\n",
                group.entries,
                group.name,
                group.mean,
                number(group.spread, 2),
                group.best_mean,
                group.best
            );
        }
        text
    }
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or("-".to_owned(), |value| format!("{value:.digits$}"))
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Sample standard deviation; of two values or more.
fn spread(values: &[f64]) -> Option<f64> {
    let mean = mean(values)?;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (values.len() > 1).then(|| (squares / (values.len() - 1) as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compared(name: &str, degrees: &[Option<f32>]) -> EntryResult {
        let text = "network = \"normal\"\nsteps = 60\nsize = 16\n";
        let entry = Entry {
            name: name.to_owned(),
            random: name.starts_with("random"),
            ..Entry::plain()
        };
        let recipe = TrainRecipe::parse("r.toml", text).unwrap();
        let mut compared = EntryResult::new(&entry, &recipe);
        for (seed, &degrees) in degrees.iter().enumerate() {
            compared.add(SeedResult {
                degrees,
                hours: Some(0.5 + seed as f64),
                ..SeedResult::diverged(seed as u64)
            });
        }
        compared
    }

    /// Numbers by hand.
    #[test]
    fn means_and_spreads() {
        let entries = vec![
            compared("random-1", &[Some(20.0), Some(24.0)]),
            compared("found", &[Some(10.0), Some(12.0), Some(17.0)]),
            compared("random-2", &[Some(30.0)]),
            compared("random-3", &[Some(1.0), None]),
            compared("waiting", &[]),
        ];
        let mut comparison = Comparison {
            state: RunState::Running,
            network: Network::Normal,
            equal: Equal::MultiplyAdds,
            multiply_adds: 1,
            recipe_sha256: String::new(),
            entries,
            groups: Vec::new(),
        };
        comparison.summarise();
        let found = &comparison.entries[1];
        // Deviations -3, -1 and 4: the squares' sum is 26.
        assert_eq!(
            (found.mean, found.spread, found.hours),
            (Some(13.0), Some(13f64.sqrt()), Some(1.5))
        );
        let one = &comparison.entries[2];
        assert_eq!((one.mean, one.spread), (Some(30.0), None));
        // One that diverged has no mean that could be compared.
        assert_eq!(comparison.entries[3].mean, None);
        // Of 22 and 30.
        let group = Group {
            name: "random".to_owned(),
            entries: 2,
            mean: 26.0,
            spread: Some(32f64.sqrt()),
            best: "random-1".to_owned(),
            best_mean: 22.0,
        };
        assert_eq!(comparison.groups, [group]);
        let text = comparison.to_text();
        let names: Vec<_> = text.lines().map(|line| line.split(' ').next()).collect();
        let first = ["name", "found", "random-1", "random-2"].map(Some);
        assert_eq!(names[..4], first, "{text}");
        assert!(
            text.contains("2 of random entries: mean 26.00, spread 5.66, best 22.00 (random-1)")
        );
        let json = serde_json::to_string(&comparison).unwrap();
        assert_eq!(
            serde_json::from_str::<Comparison>(&json).unwrap(),
            comparison
        );
    }
}
