//! Table and page of what is there.
use crate::record::{RECORD, Record};
use crate::row::Details;
use crate::walk::walk;
use crate::{BatchError, BatchSummary, Outcome, Row, Shard, output, table};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Duration, UNIX_EPOCH};

/// Writes `batch.csv` and `index.html` of all results in an output, and of the captures that its tables say have none: what
/// shards left becomes one table. Nothing is estimated, and the tree of captures need not be there.
///
/// # Errors
/// [`BatchError::NothingToCollect`], [`BatchError::Read`] or [`BatchError::Io`].
pub fn collect(output: &Path) -> Result<BatchSummary, BatchError> {
    let place = output::place_of(output).map_err(|reason| BatchError::Read {
        path: output.to_owned(),
        reason,
    })?;
    let (folders, _) = walk(&place)?;
    let mut rows: BTreeMap<String, Row> = BTreeMap::new();
    for folder in folders {
        if !folder.files.iter().any(|name| name == RECORD) {
            continue;
        }
        let path = place.join(&folder.path);
        let Some(record) = Record::of(&path) else {
            continue;
        };
        let (outcome, details) = match Details::of(&path, &record) {
            Ok(details) => (Outcome::Done, Some(details)),
            Err(words) => (Outcome::Failed(words), None),
        };
        let row = Row {
            capture: record.capture.clone(),
            result: folder.path,
            outcome,
            at: UNIX_EPOCH + Duration::from_nanos(record.read),
            details,
        };
        rows.insert(record.capture, row);
    }
    for missing in table::missing(&place) {
        // A capture that failed after it had a result has changed; whether one that was not looked at has, nobody knows.
        let is_later = |before: &Row| match before.outcome {
            Outcome::Done => missing.outcome != Outcome::NotDone && missing.at > before.at,
            _ => missing.at > before.at,
        };
        if rows.get(&missing.capture).is_none_or(is_later) {
            rows.insert(missing.capture.clone(), missing);
        }
    }
    if rows.is_empty() {
        return Err(BatchError::NothingToCollect {
            path: output.to_owned(),
        });
    }
    let mut rows: Vec<Row> = rows.into_values().collect();
    rows.sort_by(|a, b| natord::compare(&a.capture, &b.capture));
    let summary = BatchSummary {
        output: place,
        shard: Shard::WHOLE,
        rows,
        stopped: None,
    };
    table::write(&summary)?;
    Ok(summary)
}
