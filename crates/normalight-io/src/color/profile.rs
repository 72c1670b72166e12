//! Colour profiles (ICC): curves and primaries, or tables.
use super::Statement;
use super::encoding::{Curves, Encoding};
use super::tables::Tables;
use moxcms::{ColorProfile, DataColorSpace, ToneReprCurve};

/// What a profile's bytes say. `instead` is what is believed where they cannot be honoured.
pub(crate) fn of_profile(bytes: &[u8], instead: Statement) -> Statement {
    read(bytes).unwrap_or_else(|reason| Statement::unknown(reason, instead))
}

fn read(bytes: &[u8]) -> Result<Statement, String> {
    let profile = ColorProfile::new_from_slice(bytes).map_err(|error| format!("{error:?}"))?;
    let name = format!("the colour profile {}", name(&profile));
    match profile.color_space {
        DataColorSpace::Gray => {
            let curve = curve(profile.gray_trc.as_ref())?;
            Encoding::statement(name, Curves::Sampled(vec![curve]), None)
        }
        DataColorSpace::Rgb if Tables::alone(&profile) => Tables::statement(name, &profile),
        DataColorSpace::Rgb => {
            let curves = [&profile.red_trc, &profile.green_trc, &profile.blue_trc]
                .into_iter()
                .map(|channel| curve(channel.as_ref()))
                .collect::<Result<_, _>>()?;
            let matrix = profile.transform_matrix(&ColorProfile::new_srgb());
            Encoding::statement(name, Curves::Sampled(curves), Some(matrix))
        }
        DataColorSpace::Cmyk => Err("it is for the inks of a print (CMYK)".to_owned()),
        other => Err(format!("it is for {other:?}")),
    }
}

fn curve(curve: Option<&ToneReprCurve>) -> Result<Vec<f32>, String> {
    let curve = curve.ok_or("it has no curves")?;
    let evaluator = curve
        .make_linear_evaluator()
        .map_err(|error| format!("{error:?}"))?;
    Ok(Curves::sampled(|code| {
        let light = evaluator.evaluate_value(code);
        // The library's power of zero is not zero.
        if code == 0.0 {
            light.clamp(0.0, 1.0)
        } else {
            light
        }
    }))
}

fn name(profile: &ColorProfile) -> String {
    use moxcms::ProfileText;
    let text = match &profile.description {
        Some(ProfileText::PlainString(text)) => text.clone(),
        Some(ProfileText::Localizable(texts)) => texts
            .first()
            .map(|text| text.value.clone())
            .unwrap_or_default(),
        Some(ProfileText::Description(text)) => text.ascii_string.clone(),
        None => String::new(),
    };
    match text.trim().trim_end_matches('\0') {
        "" => "without name".to_owned(),
        text => format!("{:?}", text.chars().take(60).collect::<String>()),
    }
}
