//! The light of the room taken away.
use crate::{Samples, StackImage};

/// Samples from here on are full: what they would be is not known.
const FULL: f32 = 0.995;

/// A shot without the light of a picture that was taken without lamp: the difference in linear
/// light, never below zero. Saturated samples stay saturated.
///
/// # Panics
/// The pictures have different sizes.
pub fn without_ambient(shot: &StackImage, ambient: &StackImage) -> StackImage {
    assert_eq!(
        (shot.width, shot.height),
        (ambient.width, ambient.height),
        "pictures of one size"
    );
    let mut room = Vec::with_capacity(ambient.width * ambient.height * ambient.channels);
    ambient.with_light(|_, light| {
        room.push(light);
        light
    });
    let saturates = !matches!(shot.samples, Samples::F32(_));
    shot.with_light(|place, light| {
        if saturates && light >= FULL {
            return light;
        }
        let (pixel, channel) = (place / shot.channels, place % shot.channels);
        let channel = match (shot.channels, ambient.channels) {
            (3, 1) => 0,
            // Green stands for grey.
            (1, 3) => 1,
            _ => channel,
        };
        (light - room[pixel * ambient.channels + channel]).max(0.0)
    })
}
