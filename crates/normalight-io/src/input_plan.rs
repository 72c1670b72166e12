//! What was decided about the files of a stack, to be said before and after anything is computed.
use crate::names::NameMatch;
use crate::notice::{Notice, some_names};
use serde::{Deserialize, Serialize};
use std::fmt;

/// What was decided about the files of a stack and why: for people ([`fmt::Display`]: a few lines,
/// with `{:#}` every file), for `report.json` and for the page.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub struct InputPlan {
    /// The photographs that were read, in order.
    pub photographs: Vec<String>,
    /// What decided about them and their order.
    pub order: Order,
    /// Files that are not among them.
    pub left_out: Vec<LeftOut>,
    /// Where the mask came from, in words or by its file name.
    pub mask: String,
    /// How samples were taken.
    pub color: ColorDecision,
    /// How given lights were matched; `None` when there were none.
    pub lights: Option<LightsDecision>,
    /// The picture without lamp that was subtracted.
    pub ambient: Option<String>,
    /// The true normals, which only serve to be compared with.
    #[serde(default)]
    pub truth: Option<String>,
    /// By how many pixels a photograph was moved at most, where that was asked for.
    pub aligned: Option<f32>,
    /// What is doubtful.
    pub notices: Vec<Notice>,
}

/// What decided about the photographs and their order.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// Their names: 2 before 10.
    #[default]
    Names,
    /// A list.
    List(String),
}

/// A file that is not among the photographs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub struct LeftOut {
    /// The file.
    pub file: String,
    /// Why.
    pub reason: LeftOutReason,
}

impl LeftOut {
    pub(crate) fn new(file: &str, reason: LeftOutReason) -> Self {
        Self {
            file: file.to_owned(),
            reason,
        }
    }
}

/// Why a file is not among the photographs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum LeftOutReason {
    /// A mask, and not the one that is used.
    Mask,
    /// A picture without lamp, by its name.
    Ambient,
    /// A picture without lamp, by what it shows.
    ShowsNoLamp,
    /// A map: a result of this or another program.
    Map {
        /// The word in its name that says so.
        word: String,
    },
    /// The list does not name it.
    NotListed,
    /// It has another size and another name than the photographs.
    OtherSize {
        /// Its width and height.
        size: [usize; 2],
    },
    /// Alone among the photographs, its name is unlike theirs.
    UnlikeNames,
    /// It is black, or nearly: it shows no light to speak of.
    TooDark,
    /// A photograph in a format that is not read.
    UnreadFormat {
        /// The format.
        format: String,
    },
    /// An archive beside photographs or in another archive: it is not opened.
    Archive,
    /// A link in an archive: it is not followed.
    Link,
    /// It lies in another folder of its archive than the photographs.
    OtherFolder,
    /// No image at all.
    NotAnImage,
    /// A helper file of an operating system.
    System,
}

impl fmt::Display for LeftOutReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mask => f.write_str("another mask"),
            Self::Ambient => f.write_str("without lamp, by its name"),
            Self::ShowsNoLamp => f.write_str("without lamp, by what it shows"),
            Self::Map { word } => write!(f, "a map, by the word {word:?} in its name"),
            Self::NotListed => f.write_str("not in the list"),
            Self::UnlikeNames => {
                f.write_str("named unlike the photographs; a list of names takes it in")
            }
            Self::TooDark => f.write_str("black, or nearly"),
            Self::OtherSize {
                size: [width, height],
            } => {
                write!(f, "another size: {width}x{height}")
            }
            Self::UnreadFormat { format } => {
                write!(
                    f,
                    "{format}, which is not read; export it as TIFF or PNG of 16 bits"
                )
            }
            Self::Archive => f.write_str("an archive, not opened: give it alone"),
            Self::Link => f.write_str("a link, not followed"),
            Self::OtherFolder => f.write_str("in another folder than the photographs"),
            Self::NotAnImage => f.write_str("no image"),
            Self::System => f.write_str("a helper file of the system"),
        }
    }
}

/// How samples were taken to relate to light.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub struct ColorDecision {
    /// `linear`, `sRGB`, or what the files say of themselves.
    pub taken: String,
    /// Why.
    pub because: ColorReason,
}

/// Why samples were taken as they were.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum ColorReason {
    /// The caller said so.
    Asked,
    /// The files say so: a profile, a chunk or their format.
    #[default]
    Stated,
    /// The files lie as those of a benchmark.
    Benchmark,
    /// The shading fits better so.
    Shading,
    /// Nothing says anything: what such files usually are.
    Usual,
}

impl fmt::Display for ColorReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Asked => "as asked",
            Self::Stated => "as the files say",
            Self::Benchmark => "files of a benchmark",
            Self::Shading => "the shading fits better so",
            Self::Usual => "usual for such files",
        })
    }
}

/// How given lights were matched with the photographs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
pub struct LightsDecision {
    /// The light file.
    pub file: String,
    /// The least sure rule that matched a light.
    pub matched: NameMatch,
    /// The file that says how bright the lights are; none for directions alone.
    pub intensities: Option<String>,
}

/// A file and why it is left out.
impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.file, self.reason)
    }
}

impl InputPlan {
    /// Puts notices before all others. Of files that the browser decoded it goes without saying that they are of another
    /// format than their names.
    pub fn say_first(&mut self, notices: Vec<Notice>) {
        let decoded = |name: &str| {
            notices.iter().any(|notice| {
                matches!(notice, Notice::DecodedByBrowser { files, .. }
                    if files.iter().any(|file| file == name))
            })
        };
        self.notices.retain(
            |notice| !matches!(notice, Notice::ContentOverExtension { file, .. } if decoded(file)),
        );
        self.notices.splice(0..0, notices);
    }

    /// In lines for people: a few, or with `all` one that names every photograph, and one for every file left out.
    pub fn lines(&self, all: bool) -> Vec<String> {
        let names = match (all, &self.photographs[..]) {
            (false, [first, .., last]) => format!("{first} to {last}"),
            (_, names) => names.join(", "),
        };
        let order = match &self.order {
            Order::Names => "by name".to_owned(),
            Order::List(list) => format!("as {list} lists them"),
        };
        let count = self.photographs.len();
        let mut lines = vec![
            format!("photographs: {count} ({order}): {names}"),
            format!("mask: {}", self.mask),
            format!("colour: {} ({})", self.color.taken, self.color.because),
        ];
        if let Some(LightsDecision {
            file,
            matched,
            intensities,
        }) = &self.lights
        {
            let beside = intensities.as_ref().filter(|beside| *beside != file);
            let beside = beside.map(|beside| format!(", with the intensities in {beside}"));
            lines.push(format!(
                "lights: {file}{}, matched by {matched}",
                beside.unwrap_or_default()
            ));
        }
        if let Some(file) = &self.ambient {
            lines.push(format!("room light: that of {file}, subtracted"));
        }
        if let Some(file) = &self.truth {
            lines.push(format!("true normals: {file}, to compare with"));
        }
        match self.aligned {
            Some(0.0) => lines.push("aligned: no photograph had to be moved".to_owned()),
            Some(most) => lines.push(format!(
                "aligned: photographs moved by up to {most:.1} pixels"
            )),
            None => (),
        }
        let mut lines: Vec<String> = lines.iter().map(|line| on_one_line(line)).collect();
        lines.extend(left_out_lines(&self.left_out, all));
        lines.extend(notice_lines(&self.notices));
        lines
    }
}

/// What is said about files that are left out: a line for each, or one for all that a person might miss.
pub fn left_out_lines(files: &[LeftOut], all: bool) -> Vec<String> {
    // Helper files are nobody's concern.
    let told = |left: &&LeftOut| all || left.reason != LeftOutReason::System;
    let label = |left: &LeftOut| on_one_line(&left.to_string());
    let files: Vec<String> = files.iter().filter(told).map(label).collect();
    match (all, files.is_empty()) {
        (_, true) => Vec::new(),
        (true, false) => files
            .iter()
            .map(|file| format!("left out: {file}"))
            .collect(),
        (false, false) => vec![format!("left out: {}", some_names(&files))],
    }
}

/// What is said about what is doubtful: a line for each, or one for the same about several files.
pub fn notice_lines(notices: &[Notice]) -> Vec<String> {
    let mut said: Vec<(Vec<String>, String)> = Vec::new();
    for notice in notices.iter().map(Notice::to_string) {
        let Some((file, words)) = notice.split_once(": ") else {
            said.push((Vec::new(), notice));
            continue;
        };
        match said
            .iter_mut()
            .find(|(files, same)| !files.is_empty() && same == words)
        {
            Some((files, _)) => files.push(file.to_owned()),
            None => said.push((vec![file.to_owned()], words.to_owned())),
        }
    }
    let line = |(files, words): (Vec<String>, String)| match files.is_empty() {
        true => on_one_line(&format!("notice: {words}")),
        false => on_one_line(&format!("notice: {}: {words}", some_names(&files))),
    };
    said.into_iter().map(line).collect()
}

/// A text whose ends of lines, which names may hold, are written out.
fn on_one_line(text: &str) -> String {
    text.replace('\n', "\\n").replace('\r', "\\r")
}

impl fmt::Display for InputPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lines(f.alternate())
            .iter()
            .try_for_each(|line| writeln!(f, "{line}"))
    }
}
