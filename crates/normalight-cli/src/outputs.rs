//! What `estimate` says at the end.
use normalight_io::{DerivedReport, ExpectedErrors, Report, TruthErrors};

/// What a person wants to know afterwards.
pub(crate) fn summary(report: &Report, files: &[&str], folder: &str) -> String {
    let seconds: Vec<String> = report
        .seconds
        .iter()
        .map(|stage| format!("{} {:.2}", stage.stage, stage.seconds))
        .collect();
    format!(
        "images:  {} of {}x{} pixels\nmask:    {}\nlights:  {}\ndevice:  {}\nquality: {}\n{}{}seconds: {}\nresults: {folder}: {}\n",
        report.inputs.len(),
        report.width,
        report.height,
        report.mask,
        report.lights_from,
        report.device,
        report.settings.quality.name(),
        expected(report.expected_errors),
        measured(report.true_errors.as_ref()),
        seconds.join(", "),
        files.join(", "),
    )
}

/// How far off the result may be, on a line.
fn expected(errors: ExpectedErrors) -> String {
    let said: Vec<String> = [("lights", errors.lights), ("normals", errors.normals)]
        .iter()
        .filter_map(|(what, error)| Some(format!("{what} {:.0} degrees", (*error)?)))
        .collect();
    match said.is_empty() {
        true => String::new(),
        false => format!("errors:  {} to be expected\n", said.join(", ")),
    }
}

/// How far off the result is, on a line.
fn measured(errors: Option<&TruthErrors>) -> String {
    let Some(errors) = errors else {
        return String::new();
    };
    let [close, ..] = errors.shares;
    format!(
        "truth:   {}: normals {:.2} degrees off on average, {:.2} in the median, {:.0} % under 11.25\n",
        errors.file,
        errors.mean,
        errors.median,
        100.0 * close,
    )
}

/// What is to be known of depth.
pub(crate) fn surface_summary(known: &DerivedReport) -> String {
    let [low, high] = known.range;
    let mut text = format!(
        "depth:   {:.1} pixels from the lowest to the highest point",
        high - low
    );
    for (count, what) in [
        (
            known.parts.saturating_sub(1),
            "more part(s) of the mask, at a distance of their own",
        ),
        (known.missing, "pixel(s) without a normal, filled in"),
        (
            known.steep,
            "pixel(s) turned away from the camera, filled in",
        ),
    ] {
        if count > 0 {
            text += &format!("; {count} {what}");
        }
    }
    if known.torn > 0.0 {
        text += &format!("; torn along {:.2} % of its neighbours", 100.0 * known.torn);
    }
    if let Some(step) = known.mesh_step.filter(|&step| step > 1) {
        text += &format!("; the mesh has a vertex every {step} pixels");
    }
    text + "\n"
}
