//! What `estimate` says at the end.
use normalight_io::Report;

/// What a person wants to know afterwards.
pub(crate) fn summary(report: &Report, files: &[&str], folder: &str) -> String {
    let seconds: Vec<String> = report
        .seconds
        .iter()
        .map(|stage| format!("{} {:.2}", stage.stage, stage.seconds))
        .collect();
    format!(
        "images:  {} of {}x{} pixels\nmask:    {}\nlights:  {}\ndevice:  {}\nquality: {}\nseconds: {}\nresults: {folder}: {}\n",
        report.inputs.len(),
        report.width,
        report.height,
        report.mask,
        report.lights_from,
        report.device,
        report.settings.quality.name(),
        seconds.join(", "),
        files.join(", "),
    )
}
