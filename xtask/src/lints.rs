//! Clippy in a build, and documentation in a run of its tests.
//!
//! `cargo clippy` and `cargo doc` go through all dependencies for themselves, for minutes, where a build has been through them
//! already. Clippy's compiler stands in for rustc on our own crates instead, and lints what it compiles; and this program
//! stands in for rustdoc where Cargo runs the examples in documentation, and writes that documentation first.

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::run;
use crate::workspace::Workspace;

/// Set for this program where it stands in for rustdoc: the folder that documentation goes to.
const DOCUMENTATION: &str = "NORMALIGHT_DOCUMENTATION";

/// The folder of the toolchain that built this program.
pub fn sysroot() -> Result<PathBuf> {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let said = run::read(Command::new(rustc).args(["--print", "sysroot"]))?;
    Ok(PathBuf::from(said.trim()))
}

/// Clippy's compiler of that toolchain.
pub fn own_driver() -> Result<PathBuf> {
    let name = format!("clippy-driver{}", env::consts::EXE_SUFFIX);
    Ok(sysroot()?.join("bin").join(name))
}

/// Has a build lint the workspace's own crates; warnings fail.
///
/// # Errors
/// There is no such compiler.
pub fn lint(command: &mut Command, driver: &Path) -> Result<()> {
    if !driver.is_file() {
        bail!("{} is missing: it is a part of Clippy", driver.display());
    }
    // As `cargo clippy -- -D warnings` hands it on.
    let arguments = ["-D", "warnings", ""].join("__CLIPPY_HACKERY__");
    command
        .env("RUSTC_WORKSPACE_WRAPPER", driver)
        .env("CLIPPY_ARGS", arguments);
    Ok(())
}

/// Has a `cargo test --doc` write the documentation of what it tests into `target/doc`; warnings fail.
pub fn document(workspace: &Workspace, command: &mut Command) -> Result<()> {
    let own = env::current_exe().context("the place of this program")?;
    command
        .env("RUSTDOC", own)
        .env(DOCUMENTATION, workspace.target.join("doc"));
    Ok(())
}

/// What this program does where it stands in for rustdoc; `None` where it does not.
pub fn as_rustdoc() -> Option<Result<()>> {
    let folder = env::var_os(DOCUMENTATION)?;
    let arguments: Vec<OsString> = env::args_os().skip(1).collect();
    Some(documented(folder, &arguments))
}

fn documented(folder: OsString, arguments: &[OsString]) -> Result<()> {
    let rustdoc = sysroot()?.join("bin").join("rustdoc");
    if arguments.iter().any(|argument| argument == "--test") {
        let mut command = Command::new(&rustdoc);
        command.args(without_tests(arguments));
        run::run(
            command
                .arg("--out-dir")
                .arg(folder)
                .args(["-D", "warnings"]),
        )?;
    }
    run::run(Command::new(&rustdoc).args(arguments))
}

/// Arguments to write documentation, of those to test it.
fn without_tests(arguments: &[OsString]) -> Vec<OsString> {
    let mut kept = Vec::new();
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        match argument.to_str() {
            Some("--test") => (),
            Some("--test-run-directory" | "--test-args" | "--test-runtool") => {
                arguments.next();
            }
            _ => kept.push(argument.clone()),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_tests_is_taken_away() {
        let given = [
            "--crate-name",
            "a",
            "--test",
            "src/lib.rs",
            "--test-run-directory",
            "/b",
            "-L",
            "c",
        ];
        let kept = without_tests(&given.map(OsString::from));
        assert_eq!(kept, ["--crate-name", "a", "src/lib.rs", "-L", "c"]);
    }
}
