//! Behaves as `normalight estimate` does, in a few milliseconds: its pictures are made of the bytes of the capture. A file
//! `behaviour.txt` in a capture says how it misbehaves; `--size N` sets the size of the maps.
use image::{ImageBuffer, ImageFormat, Rgb};
use normalight_io::{
    ColorDecision, ColorMode, ColorReason, InputPlan, NormalFormat, Notice, OutputFolder, Report,
    ReportSettings, StageSeconds, WeightHashes, report_json,
};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::{ExitCode, abort};
use std::thread::sleep;
use std::time::Duration;

fn main() -> ExitCode {
    normalight_batch::end_with_batch();
    let arguments: Vec<_> = std::env::args_os().skip(1).collect();
    assert_eq!(arguments[0], "estimate");
    assert_eq!(arguments[2], "--out");
    assert!(arguments.last().is_some_and(|last| last == "--quiet"));
    let (capture, out) = (PathBuf::from(&arguments[1]), PathBuf::from(&arguments[3]));
    let folder = OutputFolder::prepare(&out).expect("a folder for the results");
    let mut names: Vec<PathBuf> = match capture.is_dir() {
        true => files(&capture),
        false => vec![capture.clone()],
    };
    names.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for path in &names {
        for byte in std::fs::read(path).expect("a photograph") {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }
    let files = results(&names, hash, &arguments);
    let behaviour = std::fs::read_to_string(capture.join("behaviour.txt")).unwrap_or_default();
    match behaviour.trim() {
        "fail" => {
            eprintln!("error: {}: found 2 images", capture.display());
            return ExitCode::FAILURE;
        }
        "panic" => panic!("not expected"),
        "abort" => abort(),
        "half" => {
            std::fs::write(out.join("normals.png"), &files[0].1[..20]).expect("half a file");
            abort();
        }
        "hang" => sleep(Duration::from_secs(3600)),
        "alone" => {
            let place = capture.with_file_name("alone");
            std::fs::File::create_new(&place).expect("nobody else at work");
            sleep(Duration::from_millis(30));
            std::fs::remove_file(place).expect("the own file");
        }
        "talk" => {
            for _ in 0..20_000 {
                eprintln!("a line of a warning that nobody reads");
            }
        }
        "full" => {
            let reason = std::io::Error::from_raw_os_error(if cfg!(windows) { 112 } else { 28 });
            eprintln!("error: normals.png: cannot be written: {reason}");
            return ExitCode::FAILURE;
        }
        "empty" => return ExitCode::SUCCESS,
        "touch" => {
            let photograph = capture.join("1.png");
            let bytes = std::fs::read(&photograph).expect("a photograph");
            std::fs::write(photograph, bytes).expect("the same photograph");
        }
        "change" => {
            std::fs::write(capture.join("1.png"), "others").expect("a photograph");
        }
        text => {
            if let Some(slow) = text.strip_prefix("slow ") {
                sleep(Duration::from_millis(slow.parse().expect("milliseconds")));
            }
        }
    }
    folder.write(&files).expect("results");
    ExitCode::SUCCESS
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.filter(|path| path.is_file()).collect()
}

fn results(
    names: &[PathBuf],
    hash: u64,
    arguments: &[std::ffi::OsString],
) -> Vec<(&'static str, Vec<u8>)> {
    let size = arguments
        .iter()
        .skip_while(|argument| *argument != "--size")
        .nth(1)
        .map_or(40, |size| size.to_string_lossy().parse().expect("a size"));
    let picture = |salt: u32| {
        let bytes = hash.to_le_bytes();
        let image = ImageBuffer::from_fn(size, size / 2, |x, y| {
            let level = bytes[((x / 8 + y / 8 + salt) % 8) as usize];
            Rgb([level, x as u8, y as u8])
        });
        let mut png = Cursor::new(Vec::new());
        image
            .write_to(&mut png, ImageFormat::Png)
            .expect("a picture");
        png.into_inner()
    };
    let inputs: Vec<String> = names
        .iter()
        .filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned()))
        .collect();
    let report = Report {
        expected_errors: Default::default(),
        true_errors: None,
        version: "test".to_owned(),
        width: 40,
        height: 20,
        mask: "none".to_owned(),
        color: ColorMode::Auto,
        plan: InputPlan {
            photographs: inputs.clone(),
            color: ColorDecision {
                taken: "linear".to_owned(),
                because: ColorReason::Usual,
            },
            notices: vec![Notice::MaskGuessedWhole],
            ..InputPlan::default()
        },
        inputs,
        lights_from: "estimated".to_owned(),
        device: "none".to_owned(),
        weights: WeightHashes::default(),
        settings: ReportSettings {
            device: "auto".to_owned(),
            quality: Default::default(),
            decoding: Default::default(),
            refit: true,
            mask: "auto".to_owned(),
            lights: None,
            images: None,
            normal_format: NormalFormat::default(),
            color: ColorMode::Auto,
        },
        seconds: vec![StageSeconds {
            stage: "normals".to_owned(),
            seconds: 0.0,
        }],
    };
    vec![
        ("normals.png", picture(0)),
        ("albedo.png", picture(1)),
        (
            "lights.svg",
            b"<svg xmlns='http://www.w3.org/2000/svg'/>".to_vec(),
        ),
        ("report.json", report_json(&report).expect("a report")),
    ]
}
