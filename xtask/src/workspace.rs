//! Where things are, what they are called, and the clock of this run.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result};

use crate::run;

/// The places of this workspace and the time this run began.
pub struct Workspace {
    /// The folder of the workspace's Cargo.toml.
    pub root: PathBuf,
    /// Cargo's target directory; WebAssembly has its own below it, and so have the tools.
    pub target: PathBuf,
    started: Instant,
}

impl Workspace {
    /// Finds the workspace this program was built in.
    pub fn find() -> Result<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"))
            .parent()
            .context("xtask has no folder above it")?
            .to_path_buf();
        let target = match env::var_os("CARGO_TARGET_DIR") {
            Some(directory) => {
                std::path::absolute(directory).context("CARGO_TARGET_DIR is no path")?
            }
            None => root.join("target"),
        };
        Ok(Self {
            root,
            target,
            started: Instant::now(),
        })
    }

    /// Prints one line, after the seconds since the start.
    pub fn say(&self, line: &str) {
        run::note(&format!(
            "[{:7.1} s] {line}",
            self.started.elapsed().as_secs_f64()
        ));
    }

    /// Cargo of the toolchain that runs this program, for the native crates.
    pub fn cargo(&self, arguments: &[&str]) -> Command {
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut command = Command::new(cargo);
        command
            .args(arguments)
            .current_dir(&self.root)
            .env("CARGO_TARGET_DIR", &self.target);
        forget_this_package(&mut command);
        command
    }

    /// The WebAssembly builds' own target directory.
    pub fn wasm_target(&self) -> PathBuf {
        self.target.join("wasm")
    }

    /// The native command, which the page's tests compare the browser with.
    pub fn command_line(&self) -> PathBuf {
        self.target
            .join("release")
            .join(format!("normalight{}", env::consts::EXE_SUFFIX))
    }
}

/// Takes away what `cargo run` tells this program about its own package: build scripts that
/// watch these variables would run again under every other caller.
pub fn forget_this_package(command: &mut Command) {
    const EXACT: [&str; 6] = [
        "CARGO_MANIFEST_DIR",
        "CARGO_MANIFEST_PATH",
        "CARGO_CRATE_NAME",
        "CARGO_BIN_NAME",
        "CARGO_PRIMARY_PACKAGE",
        "OUT_DIR",
    ];
    for (name, _) in env::vars_os() {
        let Some(text) = name.to_str() else { continue };
        if EXACT.contains(&text) || text.starts_with("CARGO_PKG_") {
            command.env_remove(text);
        }
    }
}
