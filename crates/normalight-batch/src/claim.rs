//! The hidden folder of an output in which results are made, and who is at work there.
use crate::{BatchError, Shard};
use same_file::Handle;
use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Name of the hidden folder in the output.
pub(crate) const WORK: &str = ".batch-work";

/// What the file has after the name of a shard that is locked while a batch is at work on it.
const LOCK: &str = ".lock";

/// How long somebody else has to hold a lock before that batch counts as being at work.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often is looked at a lock that somebody holds.
const LOOK: Duration = Duration::from_millis(10);

/// One shard of an output, held by this batch until it is dropped; what was being made goes with it.
#[derive(Debug)]
pub(crate) struct Claim {
    base: PathBuf,
    shard: Shard,
    /// A folder of its own: a job that outlived its batch may still write into that of the batch before. It goes first.
    work: Option<TempDir>,
    /// Whether the file system knows locks.
    pub(crate) is_locked: bool,
    /// Holds the lock while it is open.
    _file: File,
}

/// Whether somebody else holds a lock.
enum Held {
    Yes,
    No,
    Unknown,
}

impl Claim {
    /// Takes the shard, and away what killed batches left half made.
    ///
    /// # Errors
    /// [`BatchError::AtWork`], [`BatchError::OtherDivision`] or [`BatchError::Write`].
    pub(crate) fn take(output: &Path, shard: Shard) -> Result<Self, BatchError> {
        let base = output.join(WORK);
        let lock = base.join(shard.name() + LOCK);
        let failed = |path: &Path| {
            let path = path.to_owned();
            move |reason| BatchError::Write { path, reason }
        };
        let (file, is_locked) = loop {
            fs::create_dir_all(&base).map_err(failed(&base))?;
            let file = match File::options().create(true).append(true).open(&lock) {
                Ok(file) => file,
                // Another batch took the folder away at its end.
                Err(error) if error.kind() == io::ErrorKind::NotFound && output.exists() => {
                    continue;
                }
                Err(reason) => return Err(failed(&lock)(reason)),
            };
            match held(&file, PATIENCE).map_err(failed(&lock))? {
                Held::Yes => {
                    return Err(BatchError::AtWork {
                        path: output.to_owned(),
                        shard: (!shard.is_whole()).then_some(shard),
                    });
                }
                Held::Unknown => break (file, false),
                Held::No if is_at(&file, &lock) => break (file, true),
                // Another batch took the file away between the two lines.
                Held::No => {}
            }
        };
        let mut claim = Self {
            base,
            shard,
            work: None,
            is_locked,
            _file: file,
        };
        claim.clear_others(output)?;
        sweep(&claim.base, shard);
        let work = tempfile::Builder::new()
            .prefix(&format!("{}.", shard.name()))
            .tempdir_in(&claim.base);
        claim.work = Some(work.map_err(failed(&claim.base))?);
        Ok(claim)
    }

    /// The folder in which results of this shard are made.
    pub(crate) fn work(&self) -> &Path {
        self.work.as_ref().map_or(&self.base, TempDir::path)
    }

    /// Looks at other shards: those of another division must not be at work, and what dead ones left goes.
    fn clear_others(&self, output: &Path) -> Result<(), BatchError> {
        let shards: BTreeSet<String> = names(&self.base)
            .into_iter()
            .filter_map(|name| Some(name.split_once('.')?.0.to_owned()))
            .collect();
        for name in shards {
            let Some(shard) = Shard::of_name(&name).filter(|&shard| shard != self.shard) else {
                continue;
            };
            let path = self.base.join(name + LOCK);
            // Those of this division may be at work: nobody waits for each of them.
            let is_refused = shard.of() != self.shard.of();
            let patience = if is_refused { PATIENCE } else { Duration::ZERO };
            match File::open(&path) {
                Ok(file) => match held(&file, patience) {
                    Ok(Held::Yes) if is_refused => {
                        return Err(BatchError::OtherDivision {
                            path: output.to_owned(),
                            found: shard.of(),
                            expected: self.shard.of(),
                        });
                    }
                    Ok(Held::No) if is_at(&file, &path) => {
                        sweep(&self.base, shard);
                        let _ = fs::remove_file(&path);
                    }
                    _ => {}
                },
                // Whoever is at work has a lock.
                Err(error) if error.kind() == io::ErrorKind::NotFound => sweep(&self.base, shard),
                Err(_) => {}
            }
        }
        Ok(())
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        drop(self.work.take());
        // Jobs that kept it from going before may have ended since.
        sweep(&self.base, self.shard);
        let _ = fs::remove_file(self.base.join(self.shard.name() + LOCK));
        // Fails while other shards are at work.
        let _ = fs::remove_dir(&self.base);
    }
}

/// Takes away the folders in which a shard made results. What stays behind, as jobs still write into it, goes with the next
/// call.
fn sweep(base: &Path, shard: Shard) {
    let prefix = shard.name() + ".";
    for name in names(base) {
        if name.starts_with(&prefix) && !name.ends_with(LOCK) {
            let _ = fs::remove_dir_all(base.join(name));
        }
    }
}

/// Names of what lies in the hidden folder.
fn names(base: &Path) -> Vec<String> {
    let entries = fs::read_dir(base).into_iter().flatten().flatten();
    entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect()
}

/// Tries to lock a file.
///
/// A batch that was killed while it started a job leaves its lock to that job until the program of the job is loaded, so a lock
/// that ends this batch counts as held only after [`PATIENCE`].
fn held(file: &File, patience: Duration) -> io::Result<Held> {
    let start = Instant::now();
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(Held::No),
            Err(TryLockError::WouldBlock) if start.elapsed() < patience => thread::sleep(LOOK),
            Err(TryLockError::WouldBlock) => return Ok(Held::Yes),
            // Some network drives know no locks.
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {
                return Ok(Held::Unknown);
            }
            Err(TryLockError::Error(error)) => return Err(error),
        }
    }
}

/// Whether this file still is the one of that name.
fn is_at(file: &File, path: &Path) -> bool {
    let open = file.try_clone().and_then(Handle::from_file);
    matches!((open, Handle::from_path(path)), (Ok(open), Ok(named)) if open == named)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shard(text: &str) -> Shard {
        text.parse().unwrap()
    }

    #[test]
    fn one_at_a_time_but_shards_together() {
        let output = tempfile::tempdir().unwrap();
        let path = output.path();
        let first = Claim::take(path, shard("1/3")).unwrap();
        let second = Claim::take(path, shard("2/3")).unwrap();
        let refused = Claim::take(path, shard("1/3")).unwrap_err();
        assert!(
            matches!(refused, BatchError::AtWork { shard: Some(one), .. } if one == shard("1/3"))
        );
        for other in [Shard::WHOLE, shard("1/2")] {
            let refused = Claim::take(path, other).unwrap_err();
            assert!(matches!(
                refused,
                BatchError::OtherDivision { found: 3, .. }
            ));
        }
        assert!(first.work().is_dir() && second.work().is_dir());
        drop((first, second));
        assert_eq!(fs::read_dir(path).unwrap().count(), 0);
        Claim::take(path, Shard::WHOLE).unwrap();
    }

    #[test]
    fn what_the_dead_left_goes_and_what_the_living_make_stays() {
        let output = tempfile::tempdir().unwrap();
        let living = Claim::take(output.path(), shard("3/3")).unwrap();
        fs::write(living.work().join("half"), "x").unwrap();
        let base = output.path().join(WORK);
        // As killed batches leave them: nobody holds a lock.
        for dead in ["1-of-3", "1-of-1", "2-of-3", "2-of-2"] {
            let folder = base.join(format!("{dead}.x"));
            fs::create_dir(&folder).unwrap();
            fs::write(folder.join("half"), "x").unwrap();
            if dead != "2-of-2" {
                fs::write(base.join(format!("{dead}.lock")), "").unwrap();
            }
        }
        let mine = Claim::take(output.path(), shard("1/3")).unwrap();
        assert_eq!(fs::read_dir(mine.work()).unwrap().count(), 0);
        let left = names(&base).into_iter();
        let left = left.filter(|name| !name.starts_with("1-of-3.") && !name.starts_with("3-of-3."));
        assert_eq!(left.collect::<Vec<_>>(), <[String; 0]>::default());
        assert!(!base.join("1-of-3.x").exists());
        assert!(living.work().join("half").exists());
        drop((mine, living));
        assert!(!base.exists());
    }
}
