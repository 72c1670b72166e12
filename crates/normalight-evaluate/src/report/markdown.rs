//! The tables for READMEs and papers.
use super::rows::{Grid, by_object, disturbed, summary};
use super::{Report, reliability, trainings};
use crate::Table;
use std::fmt::Write as _;

pub(super) fn text(report: &Report, tables: &[Table]) -> String {
    let mut text = "# Evaluation by Normalight\n\n".to_owned();
    for fact in &report.facts {
        let _ = writeln!(text, "- {}: {}", plain(&fact.name), plain(&fact.value));
    }
    write(&mut text, &summary(tables));
    for grid in by_object(tables) {
        write(&mut text, &grid);
    }
    write(&mut text, &reliability::grid(tables));
    write(&mut text, &disturbed(tables));
    write(&mut text, &trainings::grid(&report.trainings));
    text
}

fn write(text: &mut String, grid: &Grid) {
    if grid.rows.is_empty() {
        return;
    }
    let _ = write!(text, "\n## {}\n\n{}\n\n", grid.title, grid.note);
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| plain(cell)).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    *text += &line(&grid.heads);
    let rule: Vec<&str> = std::iter::once("---")
        .chain(grid.heads.iter().skip(1).map(|_| "---:"))
        .collect();
    let _ = writeln!(text, "| {} |", rule.join(" | "));
    for row in &grid.rows {
        let mut cells = row.cells.clone();
        if row.published {
            cells[0] += " (published)";
        }
        *text += &line(&cells);
    }
}

/// Words that mean nothing to Markdown but themselves.
fn plain(words: &str) -> String {
    let mut text = String::new();
    for letter in words.chars() {
        match letter {
            '\\' | '|' | '*' | '_' | '`' | '<' | '[' => text.extend(['\\', letter]),
            '\n' | '\r' => text.push(' '),
            letter => text.push(letter),
        }
    }
    text
}
