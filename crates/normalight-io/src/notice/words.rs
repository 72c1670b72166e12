//! Notices in words.
use super::Notice;
use std::fmt;

/// Some names for a message: all of a few, else the first and how many more.
pub(crate) fn some_names(names: &[String]) -> String {
    const SHOWN: usize = 6;
    let shown = names[..names.len().min(SHOWN)].join(", ");
    match names.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// A share of full scale; of tiny ones (small numbers in 16 bits) their digits too.
fn short(value: f32) -> String {
    match value.abs() {
        size if size > 0.0 && size < 0.01 => format!("{value:.1e}"),
        _ => format!("{value:.3}"),
    }
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ContentOverExtension { file, content, extension } if extension.is_empty() => {
                write!(f, "{file}: has no extension; read as {content}, which its content is")
            }
            Self::ContentOverExtension { file, content, extension } => write!(
                f,
                "{file}: the content is {content} though the extension is {extension:?}; read as {content}"
            ),
            Self::DecodedByBrowser { format, files } => write!(
                f,
                "{}: {format}, decoded by this browser as 8 bits sRGB",
                some_names(files)
            ),
            Self::FromArchive { archive, folder } if folder.is_empty() => {
                write!(f, "{archive}: an archive, read without unpacking it to the disk")
            }
            Self::FromArchive { archive, folder } => write!(
                f,
                "{archive}: an archive, read without unpacking it to the disk; photographs from its folder {folder}"
            ),
            Self::OneInEachFolder => f.write_str(
                "the photographs lie one in each of the folders here, and are taken as one stack",
            ),
            Self::PagesAsPhotographs { file, pages } => {
                write!(f, "{file}: its {pages} pages are the photographs")
            }
            Self::ListByStem { list } => write!(
                f,
                "{list}: names files with other extensions; matched without them"
            ),
            Self::ListIgnored { list } => write!(
                f,
                "{list}: by its name a list of rejects, not taken as the list of the photographs"
            ),
            Self::SeveralPages { file, pages, page } => write!(
                f,
                "{file}: has {pages} pages, page {page} was taken; save others as files of their own to use them"
            ),
            Self::Animation { file } => {
                write!(f, "{file}: an animation, of which the first picture was taken")
            }
            Self::SeveralLayers { file, taken, others } => write!(
                f,
                "{file}: holds several pictures; {taken} was taken, not {}",
                some_names(others)
            ),
            Self::ExtraChannels { file, channels } => write!(
                f,
                "{file}: {channels} channel(s) beside its colours were left out"
            ),
            Self::Infinite { file, samples } => write!(
                f,
                "{file}: {samples} infinite samples, taken as the brightest finite value"
            ),
            Self::NotNumbers { file, samples } => {
                write!(f, "{file}: {samples} samples are no numbers (NaN); taken as black")
            }
            Self::TruthUnread { reason } => {
                write!(f, "{reason}; nothing is compared with it")
            }
            Self::Orientations { files } => write!(
                f,
                "{}: turned otherwise than the other shots by their EXIF orientation; pixels of all shots were taken as stored",
                some_names(files)
            ),
            Self::ProfileNotUnderstood { file, reason, taken } => write!(
                f,
                "{file}: what it says of its colours is not understood ({reason}); taken as {taken}"
            ),
            Self::ColorUnstated { taken, sure } => {
                write!(
                    f,
                    "nothing in the photographs says how their numbers relate to light; taken as {taken}"
                )?;
                match sure {
                    Some(sure) if *sure > 0.5 => {
                        write!(f, " by their shading ({:.0} % sure)", sure * 100.0)?;
                    }
                    Some(_) => f.write_str(" by their shading, which is hardly better than a guess")?,
                    None => f.write_str(", as such files usually are")?,
                }
                f.write_str("; the colour setting (--color) says otherwise")
            }
            Self::ColorMixed { said } => write!(
                f,
                "the photographs say different things of their colours; each was read as it says: {}",
                some_names(said)
            ),
            Self::LooksOtherwise { taken, looks, factor, sure } => write!(
                f,
                "the photographs were taken as {taken} but look {looks} (which explains them {factor:.1} times better; {:.0} % sure); if so, say it with the colour setting (--color {})",
                sure * 100.0,
                looks.to_lowercase()
            ),
            Self::MaskLabels { file, parts } => write!(
                f,
                "{file}: holds {parts} parts beside the background, all taken as the object"
            ),
            Self::MaskSoft { file, share } => write!(
                f,
                "{file}: {:.0} % of it are neither dark nor bright, as in a photograph; inside is what is above the middle",
                share * 100.0
            ),
            Self::MaskFull { file } => {
                write!(f, "{file}: all of the frame is inside")
            }
            Self::MaskScaled { file, from: [width, height], to: [to_width, to_height] } => write!(
                f,
                "{file}: has {width}x{height} pixels, scaled to the {to_width}x{to_height} of the photographs"
            ),
            Self::MaskFromTransparency { file } => write!(
                f,
                "{file}: its colours show no mask, so its transparency was taken as one"
            ),
            Self::MaskInverted { file } => write!(
                f,
                "{file}: bright at the border of the frame and dark inside; taken inverted"
            ),
            Self::MaskValues { file, values, above } => write!(
                f,
                "{file}: holds the values {}; inside is what is above {}",
                values.iter().map(|&value| short(value)).collect::<Vec<_>>().join(", "),
                short(*above)
            ),
            Self::MaskGuessedWhole => f.write_str(
                "no mask was found and no object could be told from a background, so the whole frame was taken; if there is a background, give a mask",
            ),
            Self::MaskGuessUnsure { certainty } => write!(
                f,
                "no mask was found; the object was told from its background by the photographs, which agree with {:.0} % of its outline: look at the mask, or give one",
                certainty * 100.0
            ),
            Self::NearlyIdentical { files } => write!(
                f,
                "{}: nearly the same picture; did the light move?",
                some_names(files)
            ),
            Self::Black { files } => {
                write!(f, "{}: black inside the mask", some_names(files))
            }
            Self::Saturated { files, share } => write!(
                f,
                "{}: up to {:.0} % of the object are saturated; expose less",
                some_names(files),
                share * 100.0
            ),
            Self::Overexposed { share } => write!(
                f,
                "{:.0} % of the object are saturated over all photographs, where shading cannot be seen: expose less",
                share * 100.0
            ),
            Self::LampHardlyMoved { difference } => write!(
                f,
                "all photographs show nearly the same shading (they differ by {:.1} % at most); did the lamp move?",
                difference * 100.0
            ),
            Self::RoomLit { file } => write!(
                f,
                "{file}: brighter and flatter than all others; if not a strong lamp beside the camera but another light was on, leave it out"
            ),
            Self::AmbientLeftOut { file } => write!(
                f,
                "{file}: shows the object without lamp and was left out; its light can be subtracted from all photographs with the ambient setting (--ambient auto)"
            ),
            Self::NoAmbient => f.write_str(
                "no picture without lamp was recognised, by its name or by what it shows; nothing was subtracted",
            ),
            Self::AmbientBrighter { file, share } => write!(
                f,
                "{file}: brighter than the photographs on {:.0} % of the object, so it was taken with another exposure or another light; what was subtracted is wrong there",
                share * 100.0
            ),
            Self::CameraMoved { files, pixels } => write!(
                f,
                "{}: lies up to {pixels:.1} pixels beside the other photographs, so the camera or the object moved; the align setting (--align) repairs it",
                some_names(files)
            ),
            Self::Unlike { files } => write!(
                f,
                "{}: shows nothing of what the other photographs show; another object, out of focus, or moved far?",
                some_names(files)
            ),
            Self::LightsCountLine { file, said, found } => write!(
                f,
                "{file}: its first line says {said} lights, but {found} follow"
            ),
            Self::LightsUnused { file, lights } => write!(
                f,
                "{file}: {lights} of its lights belong to no photograph that is used"
            ),
            Self::LightsByPosition { file } => write!(
                f,
                "{file}: none of its names is that of a photograph, so lights were matched by their order"
            ),
            Self::LightsNotUnit { file, shortest, longest } => write!(
                f,
                "{file}: vectors of length {shortest:.3} to {longest:.3}; only their directions were used"
            ),
            Self::LightsBehind { file, behind, of } => write!(
                f,
                "{file}: {behind} of {of} lights lie behind the object (negative z)"
            ),
            Self::LightsWithoutIntensity { file, found: true } => write!(
                f,
                "{file}: gives directions only; how bright each light is was found from the photographs"
            ),
            Self::LightsWithoutIntensity { file, found: false } => write!(
                f,
                "{file}: gives directions only, and the photographs do not tell how bright each light is: all were taken as equally bright"
            ),
            Self::LightsContradict { file, axes: Some(axes) } => write!(
                f,
                "{file}: the photographs contradict these lights, since the outline of the object does not brighten towards them; it would if their axes were {axes} (--light-axes)"
            ),
            Self::LightsContradict { file, axes: None } => write!(
                f,
                "{file}: the photographs contradict these lights, since the outline of the object does not brighten towards them; look whether each belongs to its photograph, and how their axes point (--light-axes)"
            ),
            Self::LightsInPlane { degrees } => write!(
                f,
                "all lights lie nearly in one plane with the object (within {degrees:.0} degrees), so which way its surface leans across that plane cannot be told, and normals may be far off; move the lamp to all sides"
            ),
            Self::LightsOneSided { side, dark } => write!(
                f,
                "all lights came from {side} (there is none in {dark:.0} degrees of the circle); what faces away from them was never lit, and its normals are a guess"
            ),
            Self::LightsAsAngles { file, unit } => write!(
                f,
                "{file}: angles were taken as {unit}, the azimuth from right towards up"
            ),
        }
    }
}
