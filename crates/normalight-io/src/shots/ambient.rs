//! A picture without lamp: left out or subtracted.
use crate::decode::decode_stored;
use crate::input_plan::{LeftOut, LeftOutReason};
use crate::turn::turned;
use crate::{AmbientChoice, ColorMode, IoError, Notice};
use normalight_core::{
    CoreError, ImageStack, MIN_IMAGES, Mask, ShotLight, StackImage, evenly_spaced_indices,
    luminance, without_ambient,
};

/// Share of the object on which a picture without lamp may be brighter than photographs with it:
/// without a word, and at all.
const BRIGHTER: f32 = 0.05;
const TOO_BRIGHT: f32 = 0.3;

/// A picture without lamp that lies among the files, by its name.
pub(crate) struct NamedAmbient {
    /// Its file name.
    pub(crate) file: String,
    /// Its bytes, read only where it shall be subtracted.
    pub(crate) bytes: Vec<u8>,
}

/// What was done about pictures without lamp.
#[derive(Default)]
pub(crate) struct Ambient {
    /// The one that was subtracted.
    pub(crate) subtracted: Option<String>,
    /// The one that was left out because of what it shows.
    pub(crate) left_out: Option<LeftOut>,
}

/// Leaves a picture without lamp out or subtracts it, as asked; `picked` loses the position of a
/// shot that is left out.
///
/// # Errors
/// The picture cannot be decoded, has another size than the photographs, or is brighter.
pub(crate) fn settle(
    (stack, mask, picked): (&mut ImageStack, &Mask, &mut Vec<usize>),
    named: Option<NamedAmbient>,
    (choice, color): (&AmbientChoice, ColorMode),
    notices: &mut Vec<Notice>,
) -> Result<Ambient, IoError> {
    let given = match (choice, named) {
        (AmbientChoice::File(file), _) => Some(decoded(stack, &file.name, &file.bytes, color)?),
        (AmbientChoice::Auto, Some(named)) => {
            Some(decoded(stack, &named.file, &named.bytes, color)?)
        }
        (AmbientChoice::LeaveOut, Some(named)) => {
            notices.push(Notice::AmbientLeftOut { file: named.file });
            None
        }
        _ => None,
    };
    let found = match &given {
        // Given, but among the photographs as well.
        Some(ambient) => {
            (0..stack.len()).find(|&shot| stack.images()[shot].samples == ambient.samples)
        }
        None => ShotLight::new(stack, mask).ambient(),
    };
    // Three shots are needed, whatever the fourth shows.
    let found = found.filter(|_| stack.len() > MIN_IMAGES);
    let taken = match found {
        Some(shot) => {
            picked.remove(shot);
            Some(take(stack, shot)?)
        }
        None => None,
    };
    let left_out = taken
        .as_ref()
        .map(|image| LeftOut::new(&image.name, LeftOutReason::ShowsNoLamp));
    if *choice == AmbientChoice::LeaveOut {
        if let Some(left) = &left_out {
            notices.push(Notice::AmbientLeftOut {
                file: left.file.clone(),
            });
        }
        return Ok(Ambient {
            subtracted: None,
            left_out,
        });
    }
    let Some(ambient) = given.or(taken) else {
        notices.push(Notice::NoAmbient);
        return Ok(Ambient::default());
    };
    let share = brighter_share(stack, mask, &ambient)?;
    if share > TOO_BRIGHT {
        return Err(IoError::AmbientBrighter {
            name: ambient.name,
            share,
        });
    }
    if share > BRIGHTER {
        notices.push(Notice::AmbientBrighter {
            file: ambient.name.clone(),
            share,
        });
    }
    let shots = stack.images().iter();
    *stack = ImageStack::new(shots.map(|shot| without_ambient(shot, &ambient)).collect())?;
    Ok(Ambient {
        subtracted: Some(ambient.name),
        left_out,
    })
}

/// Decodes the picture as the photographs were taken, upright if it fits them so.
fn decoded(
    stack: &ImageStack,
    name: &str,
    bytes: &[u8],
    color: ColorMode,
) -> Result<StackImage, IoError> {
    let stored = decode_stored(name, bytes, color)?;
    let first = &stack.images()[0];
    let fits = |image: &StackImage| (image.width, image.height) == (first.width, first.height);
    let mut image = turned(stored.image.clone(), stored.orientation);
    if !fits(&image) {
        image = stored.image;
    }
    if !fits(&image) {
        return Err(IoError::Core(CoreError::SizeMismatch {
            name: name.to_owned(),
            found_width: image.width,
            found_height: image.height,
            expected_width: first.width,
            expected_height: first.height,
        }));
    }
    // Where its file says nothing it is as the photographs.
    if stored.stated.is_none() {
        image.transfer = first.transfer;
    }
    image.name = crate::format::base_name(name).to_owned();
    Ok(image)
}

/// Takes one shot out of the stack.
fn take(stack: &mut ImageStack, shot: usize) -> Result<StackImage, IoError> {
    let mut images = stack.images().to_vec();
    let taken = images.remove(shot);
    *stack = ImageStack::new(images)?;
    Ok(taken)
}

/// Share of the object, over all shots, that is clearly darker than the picture without lamp.
fn brighter_share(stack: &ImageStack, mask: &Mask, ambient: &StackImage) -> Result<f32, IoError> {
    let inside = mask.pixels();
    let pixels: Vec<usize> = evenly_spaced_indices(inside.len(), 2000)
        .into_iter()
        .map(|place| inside[place])
        .collect();
    let copies = vec![ambient.clone(); MIN_IMAGES];
    let ambient = ImageStack::new(copies)?;
    let light = |stack: &ImageStack, shot: usize| -> Vec<f32> {
        let mut colours = vec![[0.0; 3]; pixels.len()];
        stack.linear_pixels(shot, &pixels, &mut colours);
        colours.into_iter().map(luminance).collect()
    };
    let room = light(&ambient, 0);
    let mut darker = 0;
    for shot in 0..stack.len() {
        let pairs = light(stack, shot).into_iter().zip(&room);
        darker += pairs
            .filter(|(light, room)| *light < 0.9 * **room - 0.004)
            .count();
    }
    Ok(darker as f32 / (stack.len() * pixels.len()) as f32)
}
