//! The report as one page that needs no other file.
use super::charts::{Chart, by_expectation, by_hours, by_images};
use super::pictures::{MOST_DEGREES, MethodPictures, ObjectPictures, colour};
use super::rows::{Grid, Quantity, by_object, disturbed, summary};
use super::{Report, reliability, trainings};
use crate::published::PUBLISHED;
use crate::{EvaluateError, Table};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use normalight_io::{PAGE_SCRIPT, PAGE_STYLE};

const STYLE: &str = include_str!("report.css");
/// No request leaves the page, whatever stands in it.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

pub(super) fn page(report: &Report, tables: &[Table]) -> Result<String, EvaluateError> {
    let charts = [
        (
            Quantity::Normals,
            "Errors of the normals against the number of photographs",
        ),
        (
            Quantity::Lights,
            "Errors of the lights against the number of photographs",
        ),
    ];
    let charts: Vec<(&str, Chart)> = charts
        .into_iter()
        .filter_map(|(quantity, title)| {
            let chart = by_images(tables, quantity).transpose()?;
            Some(chart.map(|chart| (title, chart)))
        })
        .collect::<Result<_, _>>()?;
    let expectation = by_expectation(tables)?;
    let hours = by_hours(&report.trainings)?;
    let by_object = by_object(tables);
    let listed = |name: &str| {
        let mut rows = by_object.iter().flat_map(|grid| &grid.rows);
        rows.any(|row| row.published && row.cells[0] == name)
    };
    let published: Vec<_> = PUBLISHED.iter().filter(|one| listed(one.name)).collect();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { "Evaluation by Normalight" }
                style { (PreEscaped(PAGE_STYLE)) (PreEscaped(STYLE)) }
            }
            body {
                main {
                    h1 { "Evaluation by Normalight" }
                    dl {
                        @for fact in &report.facts { div { dt { (fact.name) } dd { (fact.value) } } }
                    }
                    (grid(&summary(tables)))
                    @for one in &by_object { (grid(one)) }
                    @for (title, chart) in &charts {
                        section {
                            h2 { (title) }
                            // Its figures stand in the tables above.
                            (drawn(chart, &format!("{title}, a line for each method; the figures stand in the table of all methods")))
                        }
                    }
                    (grid(&reliability::grid(tables)))
                    @if let Some(chart) = &expectation {
                        (drawn(chart, "Errors that were found against those that were expected; the figures stand in the table above"))
                    }
                    (grid(&disturbed(tables)))
                    @if !report.networks.is_empty() { (networks(&report.networks)) }
                    (grid(&trainings::grid(&report.trainings)))
                    @if let Some(chart) = &hours {
                        (drawn(chart, "Validation errors of the trainings over their hours; the last figures stand in the table above"))
                    }
                    @if !report.pictures.is_empty() { (objects(&report.pictures)) }
                    (failures(tables))
                    @if !published.is_empty() {
                        section {
                            h2 { "Published figures" }
                            ul.sources {
                                @for one in &published {
                                    li {
                                        b { (one.name) }
                                        @if let Some(size) = one.million_parameters { " (" (size) " million parameters)" }
                                        ": " (one.source)
                                        @if let Some([lights, intensities]) = one.light_means {
                                            ". Over all ten objects: lights " (lights) " degrees, intensities " (intensities)
                                        }
                                    }
                                }
                            }
                        }
                    }
                }
                script { (PreEscaped(PAGE_SCRIPT)) }
            }
        }
    };
    Ok(page.into_string())
}

fn drawn(chart: &Chart, words: &str) -> Markup {
    html! {
        figure {
            img class="chart" src=(data("image/svg+xml", chart.svg.as_bytes())) alt=(words);
            figcaption {
                ul.legend { @for (name, colour) in &chart.legend { li { span style=(format!("background: {colour}")) {} (name) } } }
            }
        }
    }
}

/// A table that sorts by its heads.
fn grid(grid: &Grid) -> Markup {
    html! {
        @if !grid.rows.is_empty() {
            section {
                h2 { (grid.title) }
                p { (grid.note) }
                div.scroll tabindex="0" role="region" aria-label=(grid.title) {
                    table {
                        thead { tr { @for (column, head) in grid.heads.iter().enumerate() { th scope="col" class=[(column < grid.words).then_some("words")] { button type="button" { (head) } } } } }
                        tbody {
                            @for row in &grid.rows {
                                tr class=[row.published.then_some("published")] {
                                    th scope="row" data-key=(row.cells[0]) {
                                        (row.cells[0])
                                        @if row.published { " " small { "published" } }
                                    }
                                    @for (column, cell) in row.cells.iter().enumerate().skip(1) { td class=[(column < grid.words).then_some("words")] data-key=(cell) { (cell) } }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Drawings of the networks.
fn networks(drawings: &[(String, Vec<u8>)]) -> Markup {
    html! {
        section {
            h2 { "Networks" }
            p { "Each box is a layer: as high as its pictures are, as wide as they have channels, whose number stands above it." }
            @for (title, svg) in drawings {
                div.scroll tabindex="0" role="region" aria-label=(title) {
                    img.network src=(data("image/svg+xml", svg)) alt=(title);
                }
            }
        }
    }
}

/// Normals, errors and lights of every object.
fn objects(pictures: &[ObjectPictures]) -> Markup {
    html! {
        section {
            h2 { "Objects" }
            p { "Normals: right is red, up is green, towards the camera is blue. Errors:" }
            (scale())
            @for object in pictures {
                h3 { (object.object) }
                div.pictures {
                    @if !object.truth.is_empty() {
                        figure {
                            img src=(data("image/png", &object.truth)) alt=(format!("True normals of {}", object.object));
                            figcaption { "True normals" }
                        }
                    }
                    @for method in &object.methods { (found(&object.object, method)) }
                }
            }
        }
    }
}

fn found(object: &str, pictures: &MethodPictures) -> Markup {
    let title = pictures.method.title();
    html! {
        div.found {
            h4 { (title) }
            div {
                figure {
                    img src=(data("image/png", &pictures.normals)) alt=(format!("Normals of {object}: {title}"));
                    figcaption { "Normals" }
                }
                @if !pictures.errors.is_empty() {
                    figure {
                        img src=(data("image/png", &pictures.errors)) alt=(format!("Errors of the normals of {object}: {title}"));
                        figcaption { "Errors" }
                    }
                }
                @if !pictures.lights.is_empty() {
                    figure {
                        img.lights src=(data("image/svg+xml", &pictures.lights)) alt=(format!("Lights of {object}, found and true: {title}"));
                        figcaption { "Lights, and lines to the true ones where these are known" }
                    }
                }
            }
        }
    }
}

/// What the colours of error maps mean.
fn scale() -> Markup {
    let stops: Vec<String> = (0..=8)
        .map(|step| format!("#{:x}", colour(f64::from(step) / 8.0)))
        .collect();
    html! {
        div.scale {
            span style=(format!("background: linear-gradient(to right, {})", stops.join(", "))) {}
            div { span { "0°" } span { (MOST_DEGREES / 2.0) "°" } span { (MOST_DEGREES) "° and more" } }
        }
    }
}

fn failures(tables: &[Table]) -> Markup {
    let failed: Vec<String> = tables
        .iter()
        .flat_map(|table| {
            table.failures.iter().map(move |failure| {
                let method = table.method.title();
                format!(
                    "{}, {method}, {}: {}",
                    failure.name,
                    table.title(),
                    failure.reason
                )
            })
        })
        .collect();
    html! {
        @if !failed.is_empty() {
            section {
                h2 { "What could not be measured" }
                ul.failures { @for line in &failed { li { (line) } } }
            }
        }
    }
}

/// A file as an address of its own.
fn data(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", STANDARD.encode(bytes))
}
