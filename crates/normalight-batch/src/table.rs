//! The table at the end.
use crate::{BatchError, BatchSummary, Outcome, Row, Shard, page};
use normalight_io::{IoError, write_files};
use std::fs;
use std::path::{Path, PathBuf};

/// The table of all captures.
const TABLE: &str = "batch.csv";
/// What names of tables of shards begin and end with.
const PART: (&str, &str) = ("batch-", ".csv");

const COLUMNS: [&str; 14] = [
    "capture",
    "result",
    "outcome",
    "message",
    "at",
    "photographs",
    "width",
    "height",
    "mask",
    "colour",
    "lights",
    "left out",
    "notices",
    "seconds",
];

/// Writes the table, of all captures the page, too: then tables of shards are of no more use, and go.
///
/// # Errors
/// [`BatchError::Io`].
pub(crate) fn write(summary: &BatchSummary) -> Result<(), BatchError> {
    let csv = csv(&summary.rows)?;
    if !summary.shard.is_whole() {
        let name = format!("{}{}{}", PART.0, summary.shard.name(), PART.1);
        return Ok(write_files(&summary.output, &[(name, csv)])?);
    }
    let page = page::page(summary).into_bytes();
    write_files(&summary.output, &[(TABLE, csv), (page::PAGE, page)])?;
    for part in parts(&summary.output) {
        // Where it stays, what is newer counts.
        let _ = fs::remove_file(part);
    }
    Ok(())
}

fn csv(rows: &[Row]) -> Result<Vec<u8>, BatchError> {
    let failed = |error: String| IoError::Encode {
        name: TABLE,
        reason: error,
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record(COLUMNS)
        .map_err(|error| failed(error.to_string()))?;
    for row in rows {
        let message = match &row.outcome {
            Outcome::Failed(words) => words,
            _ => "",
        };
        let result = row.result.to_string_lossy();
        let mut cells = vec![
            row.capture.clone(),
            result.into_owned(),
            row.outcome.word().to_owned(),
            message.to_owned(),
            humantime::format_rfc3339_millis(row.at).to_string(),
        ];
        if let Some(details) = &row.details {
            cells.extend([
                details.photographs.to_string(),
                details.width.to_string(),
                details.height.to_string(),
                details.mask.clone(),
                details.color.clone(),
                details.lights.clone(),
                details.left_out.join("\n"),
                details.notices.join("\n"),
                format!("{:.2}", details.seconds),
            ]);
        }
        cells.resize(COLUMNS.len(), String::new());
        writer
            .write_record(&cells)
            .map_err(|error| failed(error.to_string()))?;
    }
    let bytes = writer.into_inner();
    Ok(bytes.map_err(|error| failed(error.to_string()))?)
}

/// The captures without result that the tables of an output name.
pub(crate) fn missing(output: &Path) -> Vec<Row> {
    let mut tables = parts(output);
    tables.push(output.join(TABLE));
    tables.iter().flat_map(|path| rows_of(path)).collect()
}

/// The rows of a table whose captures have no result. A table that somebody changed is read as far as it can be.
fn rows_of(path: &Path) -> Vec<Row> {
    let Ok(mut reader) = csv::Reader::from_path(path) else {
        return Vec::new();
    };
    let row = |cells: csv::StringRecord| {
        let cell = |index: usize| cells.get(index).unwrap_or_default();
        let outcome = match cell(2) {
            "failed" => Outcome::Failed(cell(3).to_owned()),
            "not done" => Outcome::NotDone,
            _ => return None,
        };
        Some(Row {
            at: humantime::parse_rfc3339(cell(4)).ok()?,
            capture: cell(0).to_owned(),
            result: PathBuf::from(cell(1)),
            outcome,
            details: None,
        })
    };
    reader.records().flatten().filter_map(row).collect()
}

/// The tables of shards in an output.
fn parts(output: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(output).into_iter().flatten().flatten();
    let is_part = |name: &str| {
        let shard = name.strip_prefix(PART.0)?.strip_suffix(PART.1)?;
        Shard::of_name(shard)
    };
    entries
        .filter(|entry| entry.file_name().to_str().and_then(is_part).is_some())
        .map(|entry| entry.path())
        .collect()
}
