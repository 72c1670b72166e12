//! Errors that estimates expect, beside those that were found.
use super::rows::{Grid, GridRow};
use crate::{Reliability, Table};

/// Tables of estimates that expect errors, with what came of it; not of disturbed photographs.
pub(super) fn expecting(tables: &[Table]) -> impl Iterator<Item = (&Table, Vec<Reliability>)> {
    let whole = tables.iter().filter(|table| table.disturbance.is_none());
    whole
        .map(|table| (table, table.reliability()))
        .filter(|(_, classes)| !classes.is_empty())
}

/// A line for each class of expected errors.
pub(super) fn grid(tables: &[Table]) -> Grid {
    let heads = [
        "Method",
        "Photographs",
        "Expected",
        "Found",
        "Share of the pixels",
    ];
    let rows = expecting(tables).flat_map(|(table, classes)| {
        classes.into_iter().map(|class| GridRow {
            published: false,
            cells: vec![
                table.method.title().to_owned(),
                table.title(),
                format!("{:.1}", class.expected_degrees),
                format!("{:.1}", class.found_degrees),
                format!("{:.1} %", 100.0 * class.share),
            ],
        })
    });
    Grid {
        title: "Errors to expect".to_owned(),
        note: "Every estimate says how wrong each normal may be. Pixels of which about the same was expected, and how wrong \
               they are: means in degrees over the pixels, each object counting the same."
            .to_owned(),
        rows: rows.collect(),
        words: 2,
        heads: heads.map(str::to_owned).to_vec(),
    }
}
