//! The page of all results: a file that needs nothing but the result folders beside it.
use crate::thumbnails::SHOWN;
use crate::{BatchSummary, Outcome, Row};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use normalight_io::{PAGE_SCRIPT, PAGE_STYLE};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_encode};
use std::path::Path;

/// Its name.
pub(crate) const PAGE: &str = "index.html";

const STYLE: &str = include_str!("page/page.css");

/// What is written out in addresses: all that may mean something in one.
const WRITTEN_OUT: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'.')
    .remove(b'_')
    .remove(b'~');

/// The page as HTML.
pub(crate) fn page(summary: &BatchSummary) -> String {
    let rows = &summary.rows;
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Normalight: " (rows.len()) " captures" }
                style { (PreEscaped(PAGE_STYLE)) (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Normalight: " (rows.len()) " captures" }
                p { (counts(summary)) }
                table {
                    thead {
                        tr {
                            th { "Normals" }
                            th { "Albedo" }
                            th { "Lights" }
                            @for (index, name) in ["Capture", "Outcome", "Photographs", "Pixels", "Notices", "Seconds"].into_iter().enumerate() {
                                th aria-sort=[(index == 0).then_some("ascending")] { button type="button" { (name) } }
                            }
                        }
                    }
                    tbody {
                        @for (index, one) in rows.iter().enumerate() { (row(index, one)) }
                    }
                }
                script { (PreEscaped(PAGE_SCRIPT)) }
            }
        }
    }
    .into_string()
}

fn counts(summary: &BatchSummary) -> String {
    let kinds = [
        Outcome::Done,
        Outcome::Unchanged,
        Outcome::Failed(String::new()),
        Outcome::NotDone,
    ];
    let counts = kinds
        .iter()
        .map(|kind| (summary.count(kind), kind.word()))
        .filter(|(count, _)| *count > 0)
        .map(|(count, word)| format!("{count} {word}"));
    counts.collect::<Vec<_>>().join(", ")
}

fn row(index: usize, row: &Row) -> Markup {
    let place = address(&row.result);
    let (outcome, message) = match &row.outcome {
        Outcome::Failed(words) => ("failed", Some(words)),
        outcome => (outcome.word(), None),
    };
    let details = row.details.as_ref();
    let picture = |shown: &str, file: &str, what: &str| {
        html! {
            @if details.is_some() {
                a href=(format!("{place}/{file}")) {
                    img src=(format!("{place}/{shown}")) loading="lazy" alt=(format!("{what} of {}", row.capture));
                }
            }
        }
    };
    let [normals, albedo] = SHOWN;
    html! {
        tr class=(outcome.replace(' ', "-")) {
            td.picture { (picture(normals.1, normals.0, "Normal map")) }
            td.picture { (picture(albedo.1, albedo.0, "Albedo")) }
            td.picture { (picture("lights.svg", "lights.svg", "Map of the lights")) }
            // Names are in order as they stand.
            td.name data-key=(index) { bdi { (row.capture) } }
            td data-key=(outcome) { span.outcome { (outcome) } }
            @if let Some(details) = details {
                td data-key=(details.photographs) data-label="photographs" { (details.photographs) }
                td data-key=(details.width * details.height) data-label="pixels" { (details.width) "×" (details.height) }
            } @else { td data-key="" {} td data-key="" {} }
            (said(message, details.map_or(&[], |details| &details.left_out), details.map_or(&[], |details| &details.notices)))
            @if let Some(details) = details {
                td data-key=(format!("{:.0}", details.seconds * 1000.0)) data-label="seconds" { (format!("{:.1}", details.seconds)) }
            } @else { td data-key="" {} }
        }
    }
}

/// The cell of what there is to say.
fn said(message: Option<&String>, left_out: &[String], notices: &[String]) -> Markup {
    let lines = message.into_iter().chain(notices).chain(left_out);
    let lines: Vec<&String> = lines.collect();
    html! {
        td.said data-key=(notices.len() + usize::from(message.is_some())) {
            @if !lines.is_empty() {
                ul { @for line in lines { li { bdi { (line.strip_prefix("notice: ").unwrap_or(line)) } } } }
            }
        }
    }
}

/// The address of a result folder, seen from the page.
fn address(path: &Path) -> String {
    let part = |part: std::path::Component| {
        percent_encode(part.as_os_str().as_encoded_bytes(), WRITTEN_OUT).to_string()
    };
    path.components().map(part).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Shard, row::Details};
    use std::path::PathBuf;
    use std::time::SystemTime;

    #[test]
    fn no_name_becomes_markup_or_another_address() {
        let name = "a\"b'<script>alert(1)</script>&amp;#?%41\n:ü";
        let summary = BatchSummary {
            output: PathBuf::new(),
            shard: Shard::WHOLE,
            rows: vec![Row {
                capture: name.to_owned(),
                result: Path::new("x y").join(name.replace('/', "")),
                outcome: Outcome::Failed(name.to_owned()),
                at: SystemTime::UNIX_EPOCH,
                details: Some(Details {
                    photographs: 3,
                    width: 4,
                    height: 5,
                    mask: name.to_owned(),
                    color: name.to_owned(),
                    lights: name.to_owned(),
                    left_out: vec![name.to_owned()],
                    notices: vec![name.to_owned()],
                    seconds: 1.0,
                }),
            }],
            stopped: None,
        };
        let page = page(&summary);
        assert!(!page.contains("<script>alert"));
        assert!(!page.contains("a\"b"));
        assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;&amp;amp;"));
        let address =
            "x%20y/a%22b%27%3Cscript%3Ealert%281%29%3Cscript%3E%26amp%3B%23%3F%2541%0A%3A%C3%BC/";
        assert!(page.contains(&format!("src=\"{address}thumbnail-normals.png\"")));
    }
}
