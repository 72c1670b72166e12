//! One object: read once, measured in every way that is asked for and not known yet.
use super::benchmark::Source;
use super::store::Store;
use crate::args::EvaluateArgs;
use crate::interrupt;
use crate::memory::{forget_peak_memory, peak_memory};
use crate::progress::ProgressObserver;
use crate::settings::{Estimation, describe};
use crate::terminal::note;
use anyhow::Result;
use indicatif::ProgressBar;
use normalight_evaluate::{
    BenchmarkObject, EvaluateError, Measured, Method, Photographs, Trial, evaluate_object,
};
use serde_json::{Value, json};
use std::borrow::Cow;

/// Everything that is the same for all objects.
pub(super) struct Work<'a> {
    pub(super) args: &'a EvaluateArgs,
    pub(super) estimation: &'a Estimation,
    pub(super) methods: &'a [Method],
    /// The first is the one that pictures are made of.
    pub(super) choices: &'a [Photographs],
    pub(super) store: Option<&'a Store>,
    pub(super) bar: &'a ProgressBar,
}

impl Work<'_> {
    /// Every trial of an object.
    ///
    /// # Errors
    /// A store that cannot be written to. What is wrong with the object is the trials' result.
    pub(super) fn measure(&self, source: &Source) -> Result<Vec<Trial>> {
        let name = source.name();
        let files = source.files();
        let mut object = None;
        let mut trials = Vec::new();
        for &photographs in self.choices {
            // What the networks found of this choice.
            let mut networks = None;
            for &method in self.methods {
                if interrupt::asked() {
                    return Ok(trials);
                }
                let mut trial = Trial {
                    object: name.clone(),
                    method,
                    photographs,
                    result: Err(String::new()),
                };
                let made_from = self.made_from(&trial, &files);
                if let Some(found) = self.find(&trial, &made_from) {
                    self.bar.inc(1);
                    trials.push(found);
                    continue;
                }
                self.bar.set_message(format!("{name}: {}", method.name()));
                let object = object.get_or_insert_with(|| self.read(source));
                trial.result = match object {
                    Ok(object) => self.one(object, &trial, &mut networks)?,
                    Err(reason) => Err(reason.clone()),
                };
                if interrupt::asked() {
                    return Ok(trials);
                }
                match (&trial.result, self.store) {
                    (Ok(_), Some(store)) => store.keep(&trial, &made_from)?,
                    (Ok(_), None) => {}
                    (Err(reason), _) => self.complain(&trials, &trial, reason),
                }
                self.bar.inc(1);
                trials.push(trial);
            }
        }
        Ok(trials)
    }

    /// A trial that is known already, with its pictures where they are wanted.
    fn find(&self, trial: &Trial, made_from: &Value) -> Option<Trial> {
        let store = self.store?;
        let drawn = !self.is_drawn(trial) || store.has_results(trial, self.args.estimates);
        drawn.then(|| store.find(trial, made_from)).flatten()
    }

    fn is_drawn(&self, trial: &Trial) -> bool {
        self.choices.first() == Some(&trial.photographs)
    }

    /// Reads an object, leaves out what is to be left out, and scales it.
    fn read(&self, source: &Source) -> Result<BenchmarkObject, String> {
        let read = || {
            let mut object = source.read()?;
            if object.normals.is_none() && object.lights.is_none() && !self.args.estimates {
                return Err(EvaluateError::NoTruth.into());
            }
            let left_out = |at: usize| {
                let mut all = self.args.leave_out.iter();
                all.any(|one| one.object == object.name && one.photographs.contains(&(at + 1)))
            };
            let all = 0..object.stack.len();
            let kept: Vec<usize> = all.filter(|&at| !left_out(at)).collect();
            if kept.len() < object.stack.len() {
                object = object.with_photographs(&kept)?;
            }
            if let Some(size) = self.args.size {
                object = object.reduced_to(size as usize)?;
            }
            anyhow::Ok(object)
        };
        read().map_err(|error| format!("{error:#}"))
    }

    /// Measures once; the inner error is the object's.
    fn one(
        &self,
        object: &BenchmarkObject,
        trial: &Trial,
        networks: &mut Option<Measured>,
    ) -> Result<TrialResult> {
        let chosen = match chosen(object, trial.photographs) {
            Ok(chosen) => chosen,
            Err(error) => return Ok(Err(error.to_string())),
        };
        let object = chosen.as_ref();
        let Estimation {
            estimator,
            settings,
            ..
        } = self.estimation;
        // One bar for all trials; this one only listens for Ctrl-C.
        let mut observer = ProgressObserver::new(String::new(), true);
        let measured = match (trial.method, &*networks) {
            (Method::EstimatedLeastSquares, Some(found)) => found.with_least_squares(object),
            (method, _) => {
                let alone = self.args.jobs.get() == 1 && forget_peak_memory();
                let found = evaluate_object(estimator, object, method, *settings, &mut observer);
                let peak = alone.then(peak_memory).flatten();
                found.map(|found| found.with_peak_memory(peak))
            }
        };
        let measured = match measured {
            Ok(measured) => measured,
            Err(error) => return Ok(Err(error.to_string())),
        };
        if let Some(store) = self.store.filter(|_| self.is_drawn(trial)) {
            store.keep_results(trial, object, &measured)?;
            if self.args.estimates {
                store.keep_estimate(trial, &measured)?;
            }
        }
        let figures = measured.figures.clone();
        if trial.method == Method::Uncalibrated {
            *networks = Some(measured);
        }
        Ok(Ok(figures))
    }

    /// Says what went wrong, each reason once for an object.
    fn complain(&self, before: &[Trial], trial: &Trial, reason: &String) {
        if before
            .iter()
            .any(|one| one.result.as_ref().err() == Some(reason))
        {
            return;
        }
        let mut what = trial.object.clone();
        if self.methods.len() * self.choices.len() > 1 {
            what += &format!(", {}, {}", trial.method.name(), trial.photographs.words());
        }
        self.bar
            .suspend(|| note(&format!("error: {what}: {reason}")));
    }

    /// Everything that a trial depends on.
    fn made_from(&self, trial: &Trial, files: &Value) -> Value {
        let estimation = self.estimation;
        let [light, normal] = estimation.estimator.weight_hashes();
        let [uses_light, uses_normal] = trial.method.networks();
        let settings = (uses_light || uses_normal).then(|| {
            let given = trial.method.knows_lights();
            describe(&self.args.estimation, &estimation.settings, given)
        });
        let left_out = self.args.leave_out.iter();
        let left_out: Vec<String> = left_out
            .filter(|one| one.object == trial.object)
            .map(ToString::to_string)
            .collect();
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "files": files,
            "light_weights": uses_light.then_some(light),
            "normal_weights": uses_normal.then_some(normal),
            "device": (uses_light || uses_normal).then_some(&estimation.device),
            "settings": settings,
            "size": self.args.size,
            "left_out": left_out,
        })
    }
}

/// The object under the photographs that are asked for.
fn chosen(
    object: &BenchmarkObject,
    photographs: Photographs,
) -> Result<Cow<'_, BenchmarkObject>, EvaluateError> {
    let indices = photographs.indices(object.stack.len());
    let mut chosen = Cow::Borrowed(object);
    if indices.len() < object.stack.len() {
        chosen = Cow::Owned(object.with_photographs(&indices)?);
    }
    if let Some(disturbance) = photographs.disturbance {
        chosen = Cow::Owned(disturbance.apply(&chosen)?);
    }
    Ok(chosen)
}

type TrialResult = Result<normalight_evaluate::ObjectFigures, String>;
