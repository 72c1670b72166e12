//! Pictures of a search: derived cells as graphs, and the weights that led to them.

mod cell;
mod layers;
mod network;
mod weights;

pub(crate) use cell::cell_svg;
pub use network::network_drawings;
pub(crate) use weights::weights_svg;

use normalight_model::Operation;
use svg::Document;
use svg::node::element::{Rectangle, Text};

/// The picture brings its own ground, so that it reads on white and on black pages alike.
const GROUND: &str = "#fcfcfb";
const FRAME: &str = "#d5d9de";
const INK: &str = "#24292f";
const FAINT_INK: &str = "#6b737c";
const MARGIN: f64 = 20.0;
/// Space for the title, above everything else.
const HEADER: f64 = 54.0;
const FONT_SIZE: f64 = 12.0;
const TITLE_SIZE: f64 = 16.0;
/// Width of a letter in units of its font's size, at most in the mean: sans-serif fonts differ.
const LETTER: f64 = 0.62;

/// The colour of an operation in all drawings; told apart with any colour vision (after Okabe and Ito).
fn colour(operation: Operation) -> &'static str {
    match operation {
        Operation::Separable1 => "#41a9e0",
        Operation::Separable3 => "#0a58a8",
        Operation::Separable5 => "#b0549b",
        Operation::Convolution3 => "#d55e00",
        Operation::Skip => "#009468",
        Operation::Zero => "#8c949d",
    }
}

/// The name of an operation where there is little space.
fn short_name(operation: Operation) -> &'static str {
    match operation {
        Operation::Separable1 => "sep 1x1",
        Operation::Separable3 => "sep 3x3",
        Operation::Separable5 => "sep 5x5",
        Operation::Convolution3 => "conv 3x3",
        Operation::Skip => "skip",
        Operation::Zero => "zero",
    }
}

/// What an edge reads: an output of an earlier cell, or a node of this one.
fn input_name(from: usize) -> String {
    match from {
        0 => "c(k-2)".to_owned(),
        1 => "c(k-1)".to_owned(),
        node => format!("node {}", node - 2),
    }
}

/// An empty picture with its title; wider than asked if the title is.
fn page(title: &str, width: f64, height: f64) -> Document {
    let title_width = text_width(title, TITLE_SIZE) + 2.0 * MARGIN;
    let (width, height) = (width.max(title_width).ceil(), height.ceil());
    let ground = Rectangle::new()
        .set("x", 0.5)
        .set("y", 0.5)
        .set("width", width - 1.0)
        .set("height", height - 1.0)
        .set("rx", 12)
        .set("fill", GROUND)
        .set("stroke", FRAME);
    Document::new()
        .set("viewBox", (0, 0, width, height))
        .set("width", width)
        .set("height", height)
        .set("font-family", "system-ui, sans-serif")
        .set("font-size", FONT_SIZE)
        .set("fill", INK)
        .add(ground)
        .add(
            text(MARGIN, 32.0, title)
                .set("font-size", TITLE_SIZE)
                .set("font-weight", 600),
        )
}

/// Markup is escaped by the crate; control characters have no place in XML at all.
fn text(x: f64, y: f64, words: &str) -> Text {
    let words = words.replace(char::is_control, " ");
    Text::new(words).set("x", rounded(x)).set("y", rounded(y))
}

fn text_width(words: &str, size: f64) -> f64 {
    words.chars().count() as f64 * size * LETTER
}

/// To tenths of a unit: what is finer cannot be seen.
fn rounded(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}

#[cfg(test)]
mod parsed;
