//! What a search of whole networks gives: `search.json`, and a table for people.
use super::front::{is_on_front, kendall, preferred};
use super::recipe::Goal;
use super::space::Candidate;
use normalight_run::{RunState, Summary};
use normalight_train::Network;
use serde::{Deserialize, Serialize};

/// The content of `search.json`: how a search stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NetworkSearchResult {
    /// Whether everything is trained.
    pub state: RunState,
    /// Which network.
    pub network: Network,
    /// What should be small besides the error.
    pub goal: Goal,
    /// SHA-256 of `recipe.toml`.
    pub recipe_sha256: String,
    /// One after the other, as far as the search came.
    pub rounds: Vec<Rung>,
}

/// A round: what was left, trained for the same steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rung {
    /// Its number, from 1.
    pub round: usize,
    /// Steps of each training.
    pub steps: usize,
    /// In the order of their numbers.
    pub candidates: Vec<CandidateResult>,
    /// Kendall's tau between the errors of this round and those of the round before, of the candidates in both.
    pub tau: Option<f64>,
}

/// A candidate and its error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CandidateResult {
    /// Its number, from 1.
    pub number: usize,
    /// Trainable parameters, the auxiliary tower left out.
    pub parameters: usize,
    /// Multiply-adds for ten images.
    pub multiply_adds: u64,
    /// Milliseconds for ten images on the device of the search; where time is the goal.
    pub milliseconds: Option<f64>,
    /// Best validation error in degrees; nothing before its training has ended, or when it diverged.
    pub degrees: Option<f64>,
    /// Hours of training.
    pub hours: Option<f64>,
    /// Whether none of its round is better in both.
    pub on_front: bool,
    /// What it is.
    #[serde(flatten)]
    pub candidate: Candidate,
}

impl CandidateResult {
    /// Error and hours of a training that is finished.
    pub(super) fn take(&mut self, summary: &Summary) {
        self.degrees = summary.best.as_ref().map(|best| f64::from(best.degrees));
        self.hours = Some(summary.hours);
    }

    /// Error and cost; not finite where there is none.
    fn point(&self, goal: Goal) -> [f64; 2] {
        let cost = match goal {
            Goal::MultiplyAdds => self.multiply_adds as f64,
            Goal::Parameters => self.parameters as f64,
            Goal::Time => self.milliseconds.unwrap_or(f64::INFINITY),
        };
        [self.degrees.unwrap_or(f64::INFINITY), cost]
    }
}

impl NetworkSearchResult {
    /// Marks the front of the last round, and says how its ranks agree with those of the round before.
    pub(super) fn summarise(&mut self) {
        let goal = self.goal;
        let Some((last, before)) = self.rounds.split_last_mut() else {
            return;
        };
        let points: Vec<[f64; 2]> = last.candidates.iter().map(|one| one.point(goal)).collect();
        for (at, candidate) in last.candidates.iter_mut().enumerate() {
            candidate.on_front = is_on_front(&points, at);
        }
        let earlier = before.last().map_or(&[][..], |rung| &rung.candidates);
        let pairs = last.candidates.iter().filter_map(|now| {
            let then = earlier.iter().find(|then| then.number == now.number)?;
            Some((now.degrees?, then.degrees?))
        });
        let (now, then): (Vec<f64>, Vec<f64>) = pairs.unzip();
        last.tau = kendall(&now, &then);
    }

    /// Numbers of the candidates that a round leaves, ascending.
    pub(super) fn kept(&self, count: usize) -> Vec<usize> {
        let Some(last) = self.rounds.last() else {
            return Vec::new();
        };
        let points: Vec<[f64; 2]> = last
            .candidates
            .iter()
            .map(|one| one.point(self.goal))
            .collect();
        let mut kept: Vec<usize> = preferred(&points)
            .into_iter()
            .take(count)
            .map(|at| last.candidates[at].number)
            .collect();
        kept.sort_unstable();
        kept
    }

    /// A table of each round for people, the smallest error first.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for rung in &self.rounds {
            let tau = rung.tau.map_or(String::new(), |tau| {
                format!(", ranks against the round before: tau {tau:.2}")
            });
            text += &format!("round {}: {} steps{tau}\n", rung.round, rung.steps);
            let mut candidates: Vec<&CandidateResult> = rung.candidates.iter().collect();
            candidates.sort_by(|a, b| a.point(self.goal)[0].total_cmp(&b.point(self.goal)[0]));
            for one in candidates {
                let degrees = one
                    .degrees
                    .map_or("-".to_owned(), |error| format!("{error:.2}"));
                let time = one
                    .milliseconds
                    .map_or(String::new(), |ms| format!("  {ms:7.2} ms"));
                let front = if one.on_front { "  front" } else { "" };
                text += &format!(
                    "  {:>4}  {degrees:>6} degrees  {:>8} parameters  {:>7.1} M multiply-adds{time}{front}\n",
                    one.number,
                    one.parameters,
                    one.multiply_adds as f64 / 1e6,
                );
            }
        }
        text
    }
}
