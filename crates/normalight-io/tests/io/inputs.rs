//! The inputs beside the project, as their READMEs want them; skipped where they are missing.
use normalight_core::{Light, Transfer, angle_between};
use normalight_io::{
    IoError, LightAxes, MaskChoice, NameMatch, Notice, ReadOptions, StackInput, read_named,
    read_paths,
};
use std::path::{Path, PathBuf};

fn root() -> Option<PathBuf> {
    let root = std::env::var_os("NORMALIGHT_SHARED").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")),
        PathBuf::from,
    );
    let path = root.join("inputs");
    if path.is_dir() {
        return Some(path);
    }
    println!("skipped: {} is missing", path.display());
    None
}

fn read(path: &Path) -> Result<StackInput, IoError> {
    let input = read_paths(&[path.to_owned()], &ReadOptions::default());
    match &input {
        Ok(input) => println!("--- {}\n{}", path.display(), input.plan),
        Err(error) => println!("--- {}\nerror: {error}\n", path.display()),
    }
    input
}

/// Mean difference of the linear samples from the reference's, relative to their mean, at the best scale.
fn difference(input: &StackInput, reference: &StackInput) -> f32 {
    let pixels: Vec<usize> = (0..reference.mask.inside().len())
        .filter(|&p| reference.mask.inside()[p])
        .collect();
    let light = |input: &StackInput, image: usize| {
        let mut out = vec![[0.0; 3]; pixels.len()];
        input.stack.linear_pixels(image, &pixels, &mut out);
        out.into_iter()
            .map(|rgb| rgb.iter().sum::<f32>())
            .collect::<Vec<_>>()
    };
    let (mut worst, count) = (0.0f32, input.stack.len());
    for image in 0..count {
        let (a, b) = (light(input, image), light(reference, image));
        let scale = b.iter().sum::<f32>() / a.iter().sum::<f32>();
        let wrong: f32 = a.iter().zip(&b).map(|(a, b)| (a * scale - b).abs()).sum();
        worst = worst.max(wrong / b.iter().sum::<f32>());
    }
    worst
}

fn lights_off(found: &[Light], truth: &[Light]) -> f32 {
    let angles = found
        .iter()
        .zip(truth)
        .map(|(a, b)| angle_between(a.direction, b.direction));
    angles.fold(0.0, f32::max).to_degrees()
}

#[test]
fn photographs_of_all_kinds_are_the_reference() {
    let Some(root) = root() else { return };
    let reference = read(&root.join("00-reference/photos")).unwrap();
    assert!(
        reference
            .stack
            .images()
            .iter()
            .all(|image| image.transfer == Transfer::Linear)
    );
    for (folder, tolerance) in [
        ("01-icc-tiff16/a-srgb-tiff16", 0.02),
        ("01-icc-tiff16/b-prophoto-tiff16", 0.05),
        ("02-exif-overhead/a-quarter-turns", 0.1),
        ("03-lp-decimal-comma/photos", 0.01),
        ("04-lp-windows-lexicographic/photos", 0.02),
        ("08-maps-among-photos/b-other-tool-results", 0.01),
        ("09-mask-values/photos", 0.01),
        ("11-extension-lies/photos", 0.15),
        ("12-tiff-variants/a-float32-grey", 0.05),
        ("12-tiff-variants/b-jpeg-ycbcr", 0.15),
        ("12-tiff-variants/c-bigtiff", 0.02),
        ("12-tiff-variants/f-grey-alpha", 0.05),
        ("12-tiff-variants/h-palette", 0.15),
        ("12-tiff-variants/i-tiled-planar-control", 0.02),
        ("13-exr-variants/a-luminance-only", 0.05),
        ("13-exr-variants/d-dwaa-control", 0.05),
        ("16-names-unicode-case/a-nfd-files-nfc-list", 0.01),
        ("19-own-names-and-lists/a-object-called-mask", 0.01),
    ] {
        let path = root.join(folder);
        if !path.is_dir() {
            continue;
        }
        let input = read(&path).unwrap();
        assert_eq!(input.stack.len(), 12, "{folder}");
        if (input.stack.width(), input.stack.height())
            == (reference.stack.width(), reference.stack.height())
        {
            let found = difference(&input, &reference);
            println!("{folder}: {found:.4}");
            assert!(found < tolerance, "{folder}: {found}");
        }
    }
    let turned = read(&root.join("02-exif-overhead/a-quarter-turns")).unwrap();
    assert!(
        turned
            .plan
            .notices
            .iter()
            .any(|notice| matches!(notice, Notice::Orientations { .. }))
    );
    let _ = read(&root.join("02-exif-overhead/c-all-turned"));
    let yale = read(&root.join("18-pgm-yale-names/yaleB01")).unwrap();
    assert_eq!(yale.stack.len(), 12);
    let project = root.join("14-rti-project-folder/Xun Stela 9");
    let error = read(&project).unwrap_err().to_string();
    assert!(error.contains("12 in jpeg-exports"), "{error}");
    let stela = read(&project.join("jpeg-exports")).unwrap();
    let lp = project.join("assembly-files/Xun Stela 9.lp");
    let given = stela.given_lights_path(&lp, LightAxes::default()).unwrap();
    assert_eq!(given.matched, NameMatch::PathEnd);
}

#[test]
fn lights_of_all_kinds_are_the_reference() {
    let Some(root) = root() else { return };
    let reference = read(&root.join("00-reference/photos")).unwrap();
    let truth = reference
        .read_lights_path(&root.join("00-reference/light_directions.txt"))
        .unwrap();
    for (photographs, lights) in [
        (
            "03-lp-decimal-comma/photos",
            "03-lp-decimal-comma/lights.lp",
        ),
        (
            "04-lp-windows-lexicographic/photos",
            "04-lp-windows-lexicographic/Stela 9.lp",
        ),
        (
            "05-lp-rows-and-culled-photos/photos",
            "05-lp-rows-and-culled-photos/more.lp",
        ),
        (
            "06-lights-numbered-rows/photos",
            "06-lights-numbered-rows/light_directions.txt",
        ),
        (
            "16-names-unicode-case/a-nfd-files-nfc-list",
            "16-names-unicode-case/a-lights-nfc.lp",
        ),
    ] {
        let input = read(&root.join(photographs)).unwrap();
        let given = input
            .given_lights_path(&root.join(lights), LightAxes::default())
            .unwrap();
        println!("{lights}: by {}, {:?}", given.matched, given.notices);
        let truth: Vec<Light> = match input.stack.len() {
            12 => truth.clone(),
            // Which two are gone, their numbers tell.
            _ => input
                .file_names
                .iter()
                .map(|name| {
                    let number: usize = name[..3].parse().unwrap();
                    truth[number - 1]
                })
                .collect(),
        };
        assert!(lights_off(&given.lights, &truth) < 0.01, "{lights}");
    }
    let culled = read(&root.join("05-lp-rows-and-culled-photos/photos")).unwrap();
    let fewer = root.join("05-lp-rows-and-culled-photos/fewer.lp");
    println!("{}", culled.read_lights_path(&fewer).unwrap_err());
    let opencv = root.join("07-lights-other-axes/opencv_axes.txt");
    assert!(matches!(
        reference.read_lights_path(&opencv),
        Err(IoError::LightsBehind { .. })
    ));
    let axes = "x-right,y-down,z-in".parse().unwrap();
    let given = reference.given_lights_path(&opencv, axes).unwrap();
    assert!(lights_off(&given.lights, &truth) < 0.01);
}

#[test]
fn masks_of_all_kinds_are_the_reference() {
    let Some(root) = root() else { return };
    let reference = read(&root.join("00-reference/photos")).unwrap();
    for mask in [
        "09-mask-values/masks/jpeg.jpg",
        "09-mask-values/masks/labels-0-1-2.png",
        "09-mask-values/masks/one-bit.png",
        "09-mask-values/masks/ones.png",
        "10-mask-alpha-inverted/masks/inverted.png",
        "10-mask-alpha-inverted/masks/white-with-alpha.png",
    ] {
        let path = root.join(mask);
        let options = ReadOptions {
            mask: MaskChoice::File(read_named(&path).unwrap()),
            ..ReadOptions::default()
        };
        let photographs = root.join(mask.split('/').next().unwrap()).join("photos");
        let input = read_paths(&[photographs], &options).unwrap();
        println!("{mask}: {:?}", input.plan.notices);
        let pairs = input.mask.inside().iter().zip(reference.mask.inside());
        let wrong = pairs.filter(|(a, b)| a != b).count();
        assert!(wrong < 60, "{mask}: {wrong} of {}", reference.mask.count());
    }
}
