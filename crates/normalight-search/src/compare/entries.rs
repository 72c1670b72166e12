//! What is compared, and what it is called.
use normalight_model::{Cell, Genotypes};
use normalight_run::{RunError, read_text};
use normalight_train::{Network, TrainError};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};

/// What a search leaves.
const FOUND: &str = "genotype.json";

/// Name of the plain network.
const PLAIN: &str = "plain";

/// One that is compared.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    /// Its own.
    pub(super) name: String,
    /// Whether it stands for chance: its file's name begins with `random`.
    pub(super) random: bool,
    /// The network.
    pub(super) body: Body,
}

/// What kind of network.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Body {
    /// One with these cells.
    Cells(Box<Genotypes>),
    /// The plain one.
    Plain,
}

impl Entry {
    pub(super) fn plain() -> Self {
        Self {
            name: PLAIN.to_owned(),
            random: false,
            body: Body::Plain,
        }
    }

    /// How often each operation stands in its cells for a network.
    pub(super) fn operations(&self, network: Network) -> BTreeMap<String, usize> {
        let mut counts = BTreeMap::new();
        for cell in self.cells(network) {
            for edge in cell.nodes.iter().flatten() {
                *counts.entry(edge.operation.name().to_owned()).or_default() += 1;
            }
        }
        counts
    }

    fn cells(&self, network: Network) -> Vec<&Cell> {
        let Body::Cells(genotypes) = &self.body else {
            return Vec::new();
        };
        match network {
            Network::Light => genotypes.light.iter().flat_map(|one| one.cells()).collect(),
            Network::Normal => genotypes
                .normal
                .iter()
                .flat_map(|one| one.cells())
                .collect(),
        }
    }
}

/// Reads the genotypes of all paths: files, or folders with the `genotype.json` of a search or with files of genotypes.
///
/// # Errors
/// What cannot be read, breaks a rule or lacks cells of the network, each naming the file.
pub(super) fn read_entries(paths: &[PathBuf], network: Network) -> Result<Vec<Entry>, TrainError> {
    let mut files = Vec::new();
    for path in paths {
        files.extend(genotype_files(path)?);
    }
    let names = unique_names(&files)?;
    files
        .iter()
        .zip(names)
        .map(|(file, name)| {
            Ok(Entry {
                name,
                random: own_name(file)[0].starts_with("random"),
                body: Body::Cells(Box::new(read(file, network)?)),
            })
        })
        .collect()
}

fn read(file: &Path, network: Network) -> Result<Genotypes, TrainError> {
    let name = file.display().to_string();
    let failed = |reason: String| {
        TrainError::Run(RunError::Recipe {
            file: name.clone(),
            reason,
        })
    };
    let genotypes = match Genotypes::from_json(&name, &read_text(file)?) {
        // Names the file itself.
        Err(error @ normalight_model::ModelError::Json { .. }) => return Err(error.into()),
        genotypes => genotypes.map_err(|error| failed(error.to_string()))?,
    };
    let held = [
        (Network::Light, genotypes.light.is_some()),
        (Network::Normal, genotypes.normal.is_some()),
    ];
    if held.contains(&(network, true)) {
        return Ok(genotypes);
    }
    let found: Vec<_> = held.iter().filter(|(_, held)| *held).collect();
    let found = match found.first() {
        Some((other, _)) => format!("found cells of a {} network", other.name()),
        None => "found no cells".to_owned(),
    };
    Err(failed(format!(
        "{found}, expected cells of a {} network",
        network.name()
    )))
}

/// The files that a path stands for.
fn genotype_files(path: &Path) -> Result<Vec<PathBuf>, TrainError> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let found = path.join(FOUND);
    if found.exists() {
        return Ok(vec![found]);
    }
    let failed = |reason| {
        TrainError::Run(RunError::File {
            path: path.to_owned(),
            reason,
        })
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(path).map_err(failed)? {
        let file = entry.map_err(failed)?.path();
        if file.extension() == Some(OsStr::new("json")) && may_hold_genotypes(&read_text(&file)?) {
            files.push(file);
        }
    }
    // Number 10 comes after number 9.
    files.sort_by_key(|file| (file.as_os_str().len(), file.clone()));
    if files.is_empty() {
        return Err(TrainError::Run(RunError::Recipe {
            file: path.display().to_string(),
            reason: format!("found no genotypes, expected {FOUND} or other files of genotypes"),
        }));
    }
    Ok(files)
}

/// Whether a JSON file is one of genotypes, or so broken that it might be.
fn may_hold_genotypes(text: &str) -> bool {
    match serde_json::from_str::<serde_json::Value>(text) {
        Ok(value) => value.get("light").is_some() || value.get("normal").is_some(),
        Err(_) => true,
    }
}

/// What a file is called, and what stands in front where others are called the same.
fn own_name(file: &Path) -> [String; 2] {
    let mut file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    if file.components().any(|part| part == Component::ParentDir) {
        file = file.canonicalize().unwrap_or(file);
    }
    let parent = file.parent().unwrap_or(Path::new(""));
    let word = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    if file.file_name() == Some(OsStr::new(FOUND)) {
        return [
            word(parent.file_name()),
            word(parent.parent().and_then(Path::file_name)),
        ];
    }
    [word(file.file_stem()), word(parent.file_name())]
}

/// Names of files: as short as they can be.
fn unique_names(files: &[PathBuf]) -> Result<Vec<String>, TrainError> {
    let own: Vec<[String; 2]> = files.iter().map(|file| own_name(file)).collect();
    let mut counts = BTreeMap::from([(PLAIN, 1)]);
    for [name, _] in &own {
        *counts.entry(name.as_str()).or_insert(0) += 1;
    }
    let mut names: Vec<String> = Vec::new();
    for (file, [name, front]) in files.iter().zip(&own) {
        let name = match counts[name.as_str()] {
            1 => name.clone(),
            _ => format!("{front}-{name}"),
        };
        if name == PLAIN || names.contains(&name) {
            return Err(TrainError::Run(RunError::Recipe {
                file: file.display().to_string(),
                reason: format!("found a second entry of name {name}, expected names of their own"),
            }));
        }
        names.push(name);
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_model::paper_genotypes;

    fn names(files: &[&str]) -> Result<Vec<String>, TrainError> {
        let files: Vec<PathBuf> = files.iter().map(PathBuf::from).collect();
        unique_names(&files)
    }

    #[test]
    fn names_are_short_and_never_the_same() {
        let given = ["runs/a/genotype.json", "paper.json", "b/../c/random-1.json"];
        assert_eq!(names(&given).unwrap(), ["a", "paper", "random-1"]);
        let given = ["x/a/genotype.json", "y/a/genotype.json", "z/b.json"];
        assert_eq!(names(&given).unwrap(), ["x-a", "y-a", "b"]);
        assert_eq!(names(&["own/plain.json"]).unwrap(), ["own-plain"]);
        let error = names(&["a/b.json", "a/b.json"]).unwrap_err().to_string();
        assert!(
            error.contains("a/b.json") && error.contains("a-b"),
            "{error}"
        );
        // Not by way of another file's name either.
        assert!(names(&["a/b.json", "c/b.json", "d/a-b.json"]).is_err());
    }

    #[test]
    fn folders_give_the_genotype_of_a_search_or_all_they_hold() {
        let place = tempfile::tempdir().unwrap();
        let json = serde_json::to_string(&paper_genotypes()).unwrap();
        let folder = |name: &str, files: &[(&str, &str)]| {
            let folder = place.path().join(name);
            std::fs::create_dir(&folder).unwrap();
            for (file, text) in files {
                std::fs::write(folder.join(file), text).unwrap();
            }
            folder
        };
        let search = folder("search", &[("genotype.json", &json), ("more.json", &json)]);
        let random = [
            ("random-10.json", json.as_str()),
            ("random-9.json", &json),
            ("summary.json", r#"{"network": "normal"}"#),
            ("notes.txt", "none"),
        ];
        let random = folder("chance", &random);
        let read = |paths: &[&PathBuf]| {
            let paths: Vec<_> = paths.iter().map(|path| (*path).clone()).collect();
            read_entries(&paths, Network::Normal)
        };
        let entries = read(&[&search, &random]).unwrap();
        let found: Vec<_> = entries
            .iter()
            .map(|e| (e.name.as_str(), e.random))
            .collect();
        let expected = [("search", false), ("random-9", true), ("random-10", true)];
        assert_eq!(found, expected);
        // 3 cells of 4 nodes with two edges each.
        let counts = entries[0].operations(Network::Normal);
        assert_eq!(counts.values().sum::<usize>(), 24);

        let empty = folder("empty", &[("summary.json", "{}")]);
        let error = read(&[&empty]).unwrap_err().to_string();
        assert!(
            error.contains("empty: found no genotypes, expected"),
            "{error}"
        );
        let broken = folder("broken", &[("random-1.json", "{")]);
        let error = read(&[&broken]).unwrap_err().to_string();
        assert!(error.contains("random-1.json"), "{error}");
    }
}
