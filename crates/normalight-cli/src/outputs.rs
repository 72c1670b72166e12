//! The files that `estimate` leaves.
use anyhow::Result;
use normalight_io::{
    IoError, NormalFormat, Report, StackInput, albedo_png, lights_csv, lights_lp, lights_svg,
    mask_png, normals_npy, normals_png, report_json,
};
use normalight_model::Estimate;

/// Name and content of every output, the report last: where it is, the others are complete.
pub(crate) fn encode(
    input: &StackInput,
    estimate: &Estimate,
    format: NormalFormat,
    report: &Report,
) -> Result<Vec<(&'static str, Vec<u8>)>, IoError> {
    let Estimate {
        lights,
        normals,
        albedo,
    } = estimate;
    let names = input.picked_names();
    let (width, height) = (input.stack.width(), input.stack.height());
    Ok(vec![
        ("normals.png", normals_png(normals, format)?),
        ("normals.npy", normals_npy(normals)?),
        ("lights.csv", lights_csv(&names, lights)?),
        ("lights.lp", lights_lp(&names, lights)?),
        ("lights.svg", lights_svg(lights)),
        ("albedo.png", albedo_png(albedo, width, height)?),
        ("mask.png", mask_png(&input.mask)?),
        ("report.json", report_json(report)?),
    ])
}

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
        report.settings["quality"].as_str().unwrap_or_default(),
        seconds.join(", "),
        files.join(", "),
    )
}
