use std::collections::BTreeMap;
use toml::{Table, Value};

/// One setting in which two recipes differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// Its dotted key.
    pub key: String,
    /// What it was.
    pub before: String,
    /// What it is.
    pub now: String,
}

impl std::fmt::Display for Difference {
    fn fmt(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        let Self { key, before, now } = self;
        write!(formatter, "{key} was {before}, is {now}")
    }
}

/// All settings in which two recipes, as TOML, differ, in the order of their names.
///
/// # Errors
/// A text that is not TOML.
pub fn differences(before: &str, now: &str) -> Result<Vec<Difference>, toml::de::Error> {
    let (before, now) = (flat(before)?, flat(now)?);
    let missing = "not given".to_owned();
    let mut keys: Vec<&String> = before.keys().chain(now.keys()).collect();
    keys.sort();
    keys.dedup();
    let keys = keys.into_iter();
    Ok(keys
        .filter(|key| before.get(*key) != now.get(*key))
        .map(|key| Difference {
            key: key.clone(),
            before: before.get(key).unwrap_or(&missing).clone(),
            now: now.get(key).unwrap_or(&missing).clone(),
        })
        .collect())
}

/// Dotted keys and their values as text.
fn flat(recipe: &str) -> Result<BTreeMap<String, String>, toml::de::Error> {
    fn visit(prefix: &str, value: &Value, found: &mut BTreeMap<String, String>) {
        match value {
            Value::Table(table) => {
                for (key, value) in table {
                    let dot = if prefix.is_empty() { "" } else { "." };
                    visit(&format!("{prefix}{dot}{key}"), value, found);
                }
            }
            // All of ours are f32, which as f64 would show digits that nobody wrote.
            Value::Float(number) => {
                found.insert(prefix.to_owned(), (*number as f32).to_string());
            }
            other => {
                found.insert(prefix.to_owned(), other.to_string());
            }
        }
    }
    let mut found = BTreeMap::new();
    visit(
        "",
        &Value::Table(toml::from_str::<Table>(recipe)?),
        &mut found,
    );
    Ok(found)
}
