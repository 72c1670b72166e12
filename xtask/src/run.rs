//! Running other programs.

use std::io::Write;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

/// Prints one line; a reader that went away is not an error.
pub fn note(line: &str) {
    let mut output = std::io::stdout().lock();
    let _ = writeln!(output, "{line}");
    let _ = output.flush();
}

/// Runs a program to its end and passes its output through.
pub fn run(command: &mut Command) -> Result<()> {
    let line = shown(command);
    let status = command
        .stdin(Stdio::null())
        .status()
        .with_context(|| format!("`{line}` could not start"))?;
    if !status.success() {
        bail!("`{line}` failed ({status})");
    }
    Ok(())
}

/// Runs a program to its end and keeps its output back unless it fails; returns its standard output.
pub fn read(command: &mut Command) -> Result<String> {
    let line = shown(command);
    let output = command
        .stdin(Stdio::null())
        .output()
        .with_context(|| format!("`{line}` could not start"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        bail!(
            "`{line}` failed ({}):\n{}{}",
            output.status,
            text,
            errors.trim_end()
        );
    }
    Ok(text)
}

/// Whether a program runs and succeeds; says nothing.
pub fn works(program: &str, arguments: &[&str]) -> bool {
    Command::new(program)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// The command as one would type it.
pub fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    let plain = |letter: char| letter.is_alphanumeric() || "-_=+,./:@%".contains(letter);
    let words: Vec<String> = words
        .map(|word| {
            let word = word.to_string_lossy();
            if word.chars().all(plain) {
                word.into()
            } else {
                format!("'{word}'")
            }
        })
        .collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_shown_as_typed() {
        let mut command = Command::new("cargo");
        command.args(["clippy", "--", "a b", "c>=1"]);
        assert_eq!(shown(&command), "cargo clippy -- 'a b' 'c>=1'");
    }

    #[test]
    fn a_failure_names_the_command() {
        let error = run(&mut Command::new("no-such-program-here")).unwrap_err();
        assert!(format!("{error:#}").contains("`no-such-program-here` could not start"));
    }
}
