//! One job as a process of its own.
use crate::{JOB_VARIABLE, Program};
use std::collections::VecDeque;
use std::io::{self, Read};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

/// How often is looked whether a job is at its end.
const LOOK: Duration = Duration::from_millis(20);

/// Most bytes that are kept of what a job says: its last words.
const WORDS: usize = 16 << 10;

/// What the program ends with after Ctrl-C.
const INTERRUPTED: i32 = 130;

/// How long is waited for the last words of a job that is at its end.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// How a job ended.
#[derive(Debug)]
pub(crate) enum Ended {
    /// With code 0.
    Well,
    /// Otherwise; in words.
    Badly(String),
    /// By us, as everything has to end.
    Stopped,
}

/// Calls the program for one capture and waits for its end.
pub(crate) fn run(
    program: &Program,
    capture: &Path,
    folder: &Path,
    limit: Option<Duration>,
    stop: &AtomicBool,
) -> Ended {
    let mut command = Command::new(&program.path);
    command
        .arg("estimate")
        .arg(capture)
        .arg("--out")
        .arg(folder)
        .args(&program.arguments)
        .arg("--quiet")
        .envs(
            program
                .environment
                .iter()
                .map(|(name, value)| (name, value)),
        )
        .env(JOB_VARIABLE, "1")
        // Never written into: its end tells the job that we are no more, see `end_with_batch`.
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    let child = match command.spawn() {
        Ok(child) => child,
        Err(reason) => {
            return Ended::Badly(format!(
                "{}: cannot be started: {reason}",
                program.path.display()
            ));
        }
    };
    let mut child = Running(child);
    let words = child.0.stderr.take().map(listen);
    let start = Instant::now();
    let status = loop {
        match child.0.try_wait() {
            Ok(Some(status)) => break status,
            Ok(None) if stop.load(Ordering::Relaxed) => return Ended::Stopped,
            Ok(None) if limit.is_some_and(|limit| start.elapsed() > limit) => {
                let seconds = limit.unwrap_or_default().as_secs_f64();
                return Ended::Badly(format!("ended after {seconds} seconds, the limit of time"));
            }
            Ok(None) => thread::sleep(LOOK),
            Err(reason) => return Ended::Badly(format!("cannot be waited for: {reason}")),
        }
    };
    if status.success() {
        return Ended::Well;
    }
    if may_be_interrupted(status) && is_set_soon(stop) {
        return Ended::Stopped;
    }
    let words = words.and_then(|words| words.recv_timeout(LAST_WORDS).ok());
    Ended::Badly(said(status, &words.unwrap_or_default()))
}

/// Whether a job may have ended because of Ctrl-C, which a terminal sends to it as it does to us.
fn may_be_interrupted(status: ExitStatus) -> bool {
    status.code().is_none_or(|code| code == INTERRUPTED)
}

/// Waits a little for the same signal to be heard here.
fn is_set_soon(stop: &AtomicBool) -> bool {
    (0..20).any(|_| {
        thread::sleep(LOOK);
        stop.load(Ordering::Relaxed)
    })
}

/// A process that is ended when nobody waits for it any more: what it has written is of no use.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // Both fail for a process that is at its end.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Why a job failed, in its own words where it has some.
fn said(status: ExitStatus, words: &str) -> String {
    let words = words.trim();
    match (status.code(), words.strip_prefix("error: ")) {
        (Some(1), Some(words)) => words.to_owned(),
        _ if words.is_empty() => format!("the job ended with {status}"),
        _ => format!("the job ended with {status}: {words}"),
    }
}

/// Hears what a job says, so that it never waits for us; its last words come at the end.
fn listen(mut pipe: ChildStderr) -> Receiver<String> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let (mut last, mut piece) = (VecDeque::new(), [0; 4096]);
        loop {
            match pipe.read(&mut piece) {
                Ok(count) if count > 0 => last.extend(&piece[..count]),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                _ => break,
            }
            let more = last.len().saturating_sub(WORDS);
            last.drain(..more);
        }
        let bytes: Vec<u8> = last.into();
        // Nobody hears where the job was ended.
        let _ = sender.send(String::from_utf8_lossy(&bytes).into_owned());
    });
    receiver
}

/// Whether words tell that the disk is full: what a system says ends with its own number of the error.
pub(crate) fn says_full(words: &str) -> bool {
    let codes = words.split("(os error ").skip(1);
    let mut codes = codes.filter_map(|rest| rest.split(')').next()?.parse().ok());
    codes.any(|code| is_full(&io::Error::from_raw_os_error(code)))
}

/// Whether an error says that nothing more can be written.
pub(crate) fn is_full(error: &io::Error) -> bool {
    use io::ErrorKind::{QuotaExceeded, ReadOnlyFilesystem, StorageFull};
    matches!(
        error.kind(),
        StorageFull | QuotaExceeded | ReadOnlyFilesystem
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_told_from_other_errors() {
        let words = |code| {
            format!(
                "x.png: cannot be written: {}",
                io::Error::from_raw_os_error(code)
            )
        };
        // ENOSPC, EDQUOT, EROFS; ENOENT, EACCES.
        assert!(
            [28, 122, 30]
                .map(words)
                .iter()
                .all(|words| says_full(words))
        );
        assert!(![2, 13].map(words).iter().any(|words| says_full(words)));
        assert!(!says_full("(os error "));
    }
}
