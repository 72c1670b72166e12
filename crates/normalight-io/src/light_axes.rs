//! Axes of lights that other programs give.
use normalight_core::Vec3;
use std::fmt;
use std::str::FromStr;

/// Which way the axes of a light file point. Ours, the default: x right, y up, z out of the scene
/// to the camera.
///
/// As text `x-right,y-down,z-in`: the three axes of the file in any order, each with `right`,
/// `left`, `up`, `down`, `out` (to the camera) or `in` (into the scene).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LightAxes {
    /// For x, y and z of the file: which of our axes it is, and whether it points the other way.
    axes: [(usize, bool); 3],
}

/// The words for our axes, the same way round and the other way.
const WORDS: [[&str; 2]; 3] = [["right", "left"], ["up", "down"], ["out", "in"]];

impl Default for LightAxes {
    fn default() -> Self {
        Self {
            axes: [(0, false), (1, false), (2, false)],
        }
    }
}

impl LightAxes {
    /// A vector of the file in our axes.
    pub fn to_ours(self, vector: Vec3) -> Vec3 {
        let mut ours = [0.0; 3];
        for (value, (axis, reversed)) in vector.to_array().into_iter().zip(self.axes) {
            ours[axis] = if reversed { -value } else { value };
        }
        ours.into()
    }

    /// These axes where what was taken for ours has, for each coordinate, another of our axes or points the other way.
    pub(crate) fn then(self, other: [(usize, bool); 3]) -> Self {
        Self {
            axes: self.axes.map(|(axis, reversed)| {
                let (to, turned) = other[axis];
                (to, reversed != turned)
            }),
        }
    }
}

impl fmt::Display for LightAxes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self
            .axes
            .map(|(axis, reversed)| WORDS[axis][usize::from(reversed)]);
        write!(f, "x-{x},y-{y},z-{z}")
    }
}

/// A text that is no [`LightAxes`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "found {found:?}, expected the three axes as in x-right,y-down,z-in (right, left, up, down, out, in; each direction once)"
)]
pub struct LightAxesError {
    found: String,
}

impl FromStr for LightAxes {
    type Err = LightAxesError;

    fn from_str(text: &str) -> Result<Self, LightAxesError> {
        parse(text).ok_or_else(|| LightAxesError {
            found: text.chars().take(80).collect(),
        })
    }
}

fn parse(text: &str) -> Option<LightAxes> {
    let lower = text.trim().to_lowercase();
    let mut axes = [None; 3];
    let mut used = [false; 3];
    for part in lower.split(',') {
        let (axis, word) = part.trim().split_once('-')?;
        let place = ["x", "y", "z"].iter().position(|&name| name == axis)?;
        let ours = WORDS.iter().position(|words| words.contains(&word))?;
        if axes[place].is_some() || used[ours] {
            return None;
        }
        used[ours] = true;
        axes[place] = Some((ours, WORDS[ours][1] == word));
    }
    let [Some(x), Some(y), Some(z)] = axes else {
        return None;
    };
    Some(LightAxes { axes: [x, y, z] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_turn_vectors() {
        let opencv: LightAxes = "x-right,y-down,z-in".parse().unwrap();
        assert_eq!(
            opencv.to_ours(Vec3::new(1.0, 2.0, 3.0)),
            Vec3::new(1.0, -2.0, -3.0)
        );
        let turned: LightAxes = " z-up, X-out ,y-left".parse().unwrap();
        assert_eq!(
            turned.to_ours(Vec3::new(1.0, 2.0, 3.0)),
            Vec3::new(-2.0, 3.0, 1.0)
        );
        assert_eq!(turned.to_string().parse(), Ok(turned));
        assert_eq!(LightAxes::default().to_ours(Vec3::X), Vec3::X);
    }

    #[test]
    fn axes_follow_each_other() {
        let first: LightAxes = "x-up,y-in,z-left".parse().unwrap();
        let other = [(1, true), (0, false), (2, true)];
        let vector = Vec3::new(1.0, 2.0, 3.0);
        let between = first.to_ours(vector);
        let expected = Vec3::new(between.y, -between.x, -between.z);
        assert_eq!(first.then(other).to_ours(vector), expected);
    }

    #[test]
    fn other_texts_are_refused() {
        for text in [
            "",
            "x-right",
            "x-right,y-up,z-up",
            "x-up,x-right,z-in",
            "x,y,z",
            "x-right,y-down,z-in,",
        ] {
            assert!(text.parse::<LightAxes>().is_err(), "{text}");
        }
    }
}
