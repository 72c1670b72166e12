//! Maps and the report as files.
use normalight_core::{
    CoreError, Decoding, Estimate, EstimateSettings, ImageStack, Light, Mask, MaskSource,
    NormalMap, Quality, Samples, StackImage, Transfer, Vec3,
};
use normalight_io::{
    ColorMode, ExpectedErrors, InputPlan, IoError, NormalFormat, OutputName, ReadOptions, Report,
    ReportSettings, RunDescription, StackInput, StageSeconds, Truth, WeightHashes, albedo_png,
    albedo_rgba, decode_mask, mask_png, normals_npy, normals_png, normals_rgba, report_json,
    result_files,
};

/// True normals of the upper half of 16x16 pixels, 30 degrees from the camera's direction.
fn half_known() -> Truth {
    let tilted = Vec3::new(0.5, 0.0, 0.75f32.sqrt());
    let normals = (0..256).map(|pixel| if pixel < 128 { tilted } else { Vec3::ZERO });
    Truth {
        file: "Normal_gt.mat".into(),
        normals: NormalMap::new(16, 16, normals.collect()),
    }
}

fn map() -> NormalMap {
    let normals = vec![
        Vec3::X,
        Vec3::Y,
        Vec3::Z,
        Vec3::ZERO,
        -Vec3::Y,
        Vec3::new(0.6, 0.0, 0.8),
    ];
    NormalMap::new(3, 2, normals)
}

#[test]
fn normal_maps_are_16_bit() {
    let decode = |format| image::load_from_memory(&normals_png(&map(), format).unwrap()).unwrap();
    let opengl = decode(NormalFormat::OpenGl);
    let directx = decode(NormalFormat::DirectX).into_rgb16();
    assert_eq!(opengl.color(), image::ColorType::Rgb16);
    let opengl = opengl.into_rgb16();
    assert_eq!(opengl.get_pixel(0, 0).0, [65_535, 32_768, 32_768]);
    assert_eq!(opengl.get_pixel(1, 0).0, [32_768, 65_535, 32_768]);
    // Outside it is flat.
    assert_eq!(opengl.get_pixel(0, 1).0, [32_768, 32_768, 65_535]);
    assert_eq!(directx.get_pixel(1, 0).0, [32_768, 0, 32_768]);
    assert_eq!(directx.get_pixel(1, 1).0, [32_768, 65_535, 32_768]);
}

#[test]
fn arrays_are_numpy() {
    let bytes = normals_npy(&map()).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let file = npyz::NpyFile::new(&bytes[..]).unwrap();
    assert_eq!(file.shape(), [2, 3, 3]);
    assert_eq!(file.order(), npyz::Order::C);
    let header = String::from_utf8_lossy(&bytes[..128]).into_owned();
    assert!(header.contains("'<f4'"), "{header}");
    let values: Vec<f32> = file.into_vec().unwrap();
    assert_eq!(values[..6], [1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    assert_eq!(values[9..12], [0.0; 3]);
}

#[test]
fn albedo_is_scaled_to_its_99th_percentile() {
    // 200 pixels of 2, one far brighter, some outside.
    let mut plane = vec![2.0; 200];
    plane.extend([50.0, 0.0, 0.0, 0.0]);
    let mut planes = plane.clone();
    planes.extend(plane.iter().map(|value| value * 0.2155));
    planes.extend(vec![0.0; 204]);
    let image = image::load_from_memory(&albedo_png(&planes, 204, 1).unwrap()).unwrap();
    assert_eq!(image.color(), image::ColorType::Rgb8);
    let image = image.into_rgb8();
    assert_eq!(image.get_pixel(0, 0).0, [255, 128, 0]);
    assert_eq!(image.get_pixel(200, 0).0, [255, 255, 0]);
    assert_eq!(image.get_pixel(203, 0).0, [0; 3]);
    let error = albedo_png(&planes, 203, 1).unwrap_err();
    assert!(matches!(
        error,
        IoError::Core(CoreError::SampleCount { .. })
    ));
    assert!(albedo_png(&[0.0; 12], 2, 2).is_ok());
}

#[test]
fn previews_are_transparent_outside() {
    let shown = normals_rgba(&map(), NormalFormat::OpenGl);
    assert_eq!(shown.len(), 4 * 6);
    assert_eq!(
        shown[4..16],
        [128, 255, 128, 255, 128, 128, 255, 255, 0, 0, 0, 0]
    );
    assert_eq!(normals_rgba(&map(), NormalFormat::DirectX)[5], 0);
    let planes = [1.0, 0.0, 0.2155, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let shown = albedo_rgba(&planes, 3, 1).unwrap();
    assert_eq!(shown, [255, 255, 0, 255, 0, 0, 0, 0, 128, 0, 0, 255]);
    assert!(albedo_rgba(&planes, 3, 2).is_err());
}

#[test]
fn masks_round_trip() {
    let mask = Mask::new(3, 2, vec![true, false, true, false, false, true]);
    assert_eq!(
        decode_mask("mask.png", &mask_png(&mask).unwrap()).unwrap(),
        mask
    );
    assert_eq!(ColorMode::default().to_string(), "auto");
}

#[test]
fn reports_are_json() {
    let report = Report {
        version: "0.1.0".into(),
        inputs: vec!["001.png".into()],
        width: 3,
        height: 2,
        mask: "mask.png".into(),
        color: ColorMode::Linear,
        device: "cpu".into(),
        plan: InputPlan::default(),
        lights_from: "network".into(),
        expected_errors: ExpectedErrors::default(),
        true_errors: None,
        weights: WeightHashes {
            light: Some("ab".into()),
            normal: None,
        },
        settings: ReportSettings {
            device: "auto".into(),
            quality: Quality::Fast,
            decoding: Decoding::SoftArgmax,
            refit: true,
            mask: "none".into(),
            lights: None,
            images: Some(4),
            normal_format: NormalFormat::OpenGl,
            color: ColorMode::Linear,
        },
        seconds: ["read", "lights"]
            .map(|stage| StageSeconds {
                stage: stage.into(),
                seconds: 0.5,
            })
            .into(),
    };
    let bytes = report_json(&report).unwrap();
    assert!(bytes.ends_with(b"}\n"));
    assert_eq!(serde_json::from_slice::<Report>(&bytes).unwrap(), report);
    // The words of the command line.
    let json: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    let settings = &json["settings"];
    assert_eq!(json["color"], "linear");
    assert_eq!(settings["quality"], "fast");
    assert_eq!(settings["decoding"], "soft-argmax");
    assert_eq!(settings["normal_format"], "opengl");
    assert!(settings["lights"].is_null());
}

/// Given lights are used as they are: no refit, no light network.
#[test]
fn reports_say_what_was_done_with_given_lights() {
    let image = |name: &str| StackImage {
        name: name.into(),
        width: 16,
        height: 16,
        channels: 1,
        samples: Samples::F32(vec![0.5; 256]),
        transfer: Transfer::Linear,
    };
    let input = StackInput {
        stack: ImageStack::new(["a.png", "b.png", "c.png"].map(image).into()).unwrap(),
        mask: Mask::whole(16, 16),
        mask_source: MaskSource::WholeFrame,
        file_names: Vec::new(),
        picked: Vec::new(),
        truth: Some(half_known()),
        plan: InputPlan::default(),
    };
    let reading = ReadOptions::default();
    let mut run = RunDescription {
        reading: &reading,
        settings: EstimateSettings::default(),
        lights_file: None,
        device: ["auto", "CPU"],
        weights: ["ab", "cd"],
        normal_format: NormalFormat::OpenGl,
        seconds: Vec::new(),
    };
    let estimate = Estimate {
        lights: vec![Light::new(Vec3::Z, 1.0); 3],
        normals: NormalMap::new(16, 16, vec![Vec3::Z; 256]),
        normal_errors: Some(vec![7.5; 256]),
        albedo: vec![0.5; 3 * 256],
    };
    let estimated = run.report(&input, &estimate);
    assert_eq!(estimated.expected_errors.normals, Some(7.5));
    assert!(estimated.expected_errors.lights.is_some());
    let measured = estimated.true_errors.clone().unwrap();
    assert_eq!(
        (measured.file.as_str(), measured.pixels),
        ("Normal_gt.mat", 128)
    );
    assert!((measured.mean - 30.0).abs() < 1e-3 && (measured.median - 30.0).abs() < 1e-3);
    assert_eq!(measured.shares[..2], [0.0, 0.0]);
    assert!(estimated.settings.refit && estimated.lights_from.contains("refitted"));
    assert_eq!(estimated.weights.light.as_deref(), Some("ab"));
    assert_eq!(estimated.inputs, ["a.png", "b.png", "c.png"]);
    run.lights_file = Some("lights.lp");
    let given = run.report(&input, &estimate);
    assert_eq!(given.expected_errors.lights, None);
    assert!(!given.settings.refit);
    assert_eq!(given.lights_from, "lights.lp");
    assert_eq!(given.weights.light, None);
    assert_eq!(given.settings.mask, "auto");

    let files = result_files(&input, &estimate, &given).unwrap();
    let names: std::collections::HashSet<OutputName> = files
        .iter()
        .map(|(name, _)| serde_json::from_value((*name).into()).unwrap())
        .collect();
    assert_eq!(names.len(), 10);
    let (_, picture) = &files[8];
    let picture = image::load_from_memory(picture).unwrap().to_luma8();
    // Four steps a degree; nothing where nothing is known.
    assert_eq!(
        [picture.get_pixel(3, 7)[0], picture.get_pixel(3, 8)[0]],
        [120, 0]
    );
}
