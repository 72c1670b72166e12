//! The two standard outputs.
use anyhow::{Context, Result};
use std::io::{ErrorKind, Write};

/// Writes a result to the standard output; a reader that has seen enough, such as `head`, is no
/// error.
pub(crate) fn print(text: &str) -> Result<()> {
    let mut output = std::io::stdout().lock();
    match output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush())
    {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => done.context("the standard output cannot be written to"),
    }
}

/// Tells something on the standard error output. A log that nobody reads any more must not end hours
/// of work, so failures are ignored.
pub(crate) fn note(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}
