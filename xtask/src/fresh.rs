//! Whether an output is newer than what it is made from, for the steps whose tools do not ask.

use std::fs;
use std::path::Path;
use std::time::SystemTime;

use anyhow::{Context, Result};

/// Folders that hold outputs, never inputs.
const OUTPUTS: [&str; 2] = ["node_modules", "dist"];

/// Whether `output` is missing or older than a file among `inputs` (files, or folders with all
/// below them; missing inputs are passed over). A deleted input goes unnoticed.
pub fn stale(output: &Path, inputs: &[&Path]) -> Result<bool> {
    let Ok(made) = fs::metadata(output).and_then(|data| data.modified()) else {
        return Ok(true);
    };
    for input in inputs {
        if input.exists() && newest(input)? > made {
            return Ok(true);
        }
    }
    Ok(false)
}

fn newest(path: &Path) -> Result<SystemTime> {
    let read = || format!("cannot read {}", path.display());
    let data = fs::metadata(path).with_context(read)?;
    if !data.is_dir() {
        return data.modified().with_context(read);
    }
    let mut newest = SystemTime::UNIX_EPOCH;
    for entry in fs::read_dir(path).with_context(read)? {
        let entry = entry.with_context(read)?;
        let output = OUTPUTS.iter().any(|name| entry.file_name() == *name);
        // A link may lead nowhere, or round in a circle: what it names is counted where it lies.
        let link = entry.file_type().with_context(read)?.is_symlink();
        if !output && !link {
            newest = newest.max(self::newest(&entry.path())?);
        }
    }
    Ok(newest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn write(path: &Path, age: u64) {
        let file = fs::File::create(path).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(age))
            .unwrap();
    }

    #[test]
    fn outputs_are_stale_when_missing_or_older() {
        let folder = std::env::temp_dir().join(format!("xtask-fresh-{}", std::process::id()));
        fs::create_dir_all(folder.join("src/dist")).unwrap();
        let (output, source) = (folder.join("output"), folder.join("src"));
        assert!(stale(&output, &[&source]).unwrap());

        write(&output, 50);
        write(&source.join("a"), 100);
        write(&source.join("dist/b"), 10);
        assert!(!stale(&output, &[&source, &folder.join("missing")]).unwrap());

        write(&source.join("a"), 10);
        assert!(stale(&output, &[&source]).unwrap());
        fs::remove_dir_all(folder).unwrap();
    }
}
