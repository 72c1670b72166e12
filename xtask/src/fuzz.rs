//! The fuzz targets in `fuzz/`, each for some seconds: cargo-fuzz, its set-up and its findings.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::fresh::stale;
use crate::packages::{Installing, Packages};
use crate::run;
use crate::workspace::{Workspace, forget_this_package};

/// The version of cargo-fuzz that is installed.
const VERSION: &str = "0.13.2";

/// A small file that takes more than this is a finding: memory in MiB, seconds, bytes of the file.
const LIMITS: [&str; 3] = ["-rss_limit_mb=1024", "-timeout=10", "-max_len=8192"];

/// Runs each target (or only these) for some seconds; fails when one finds something.
pub fn run(
    workspace: &Workspace,
    seconds: u32,
    only: &[String],
    installing: Installing,
) -> Result<()> {
    let fuzz = Fuzz::find(workspace, &Packages::new(workspace, installing))?;
    let targets = fuzz.targets()?;
    if let Some(unknown) = only.iter().find(|name| !targets.contains(name)) {
        bail!("there is no target {unknown}, only {}", targets.join(", "));
    }
    run::run(&mut fuzz.command("build", &[]))?;
    let mut findings = Vec::new();
    for target in targets {
        if only.is_empty() || only.contains(&target) {
            workspace.say(&format!("fuzz: {target}, {seconds} s"));
            // The others are run all the same: one finding must not hide another.
            if let Err(error) = fuzz.try_out(&target, seconds) {
                workspace.say(&format!("fuzz: {target}: {error:#}"));
                findings.push(target);
            }
        }
    }
    if !findings.is_empty() {
        bail!("found something: {}", findings.join(", "));
    }
    Ok(())
}

/// cargo-fuzz, ready to run.
struct Fuzz<'a> {
    workspace: &'a Workspace,
    program: PathBuf,
}

impl<'a> Fuzz<'a> {
    /// Finds cargo-fuzz below the target directory; if it is not there, builds it.
    fn find(workspace: &'a Workspace, packages: &Packages) -> Result<Self> {
        // libFuzzer is compiled from C++.
        if which::which("c++").is_err() {
            packages.install(&["g++"])?;
        }
        // The version is part of the name: another one is another folder.
        let home = workspace.target.join(format!("tools/cargo-fuzz-{VERSION}"));
        let installed = || which::which_in("cargo-fuzz", Some(home.join("bin")), &home).ok();
        let program = match installed() {
            Some(program) => program,
            None => {
                let mut install = workspace.cargo(&["install", "cargo-fuzz", "--locked"]);
                install.args(["--version", VERSION, "--root"]).arg(&home);
                packages.announce(&run::shown(&install))?;
                run::run(&mut install)?;
                installed().context("cargo-fuzz was installed, but is not there")?
            }
        };
        // The same versions of the decoders as everything else is built with.
        let lock = workspace.root.join("Cargo.lock");
        let own = workspace.root.join("fuzz/Cargo.lock");
        if stale(&own, &[&lock])? {
            fs::copy(&lock, &own).with_context(|| format!("cannot write {}", own.display()))?;
        }
        Ok(Self { workspace, program })
    }

    fn command(&self, subcommand: &str, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.program);
        command.arg(subcommand).current_dir(&self.workspace.root);
        if subcommand != "list" {
            let target = self.workspace.target.join("fuzz");
            command.arg("--target-dir").arg(target);
        }
        // Sanitizers are flags that a stable compiler takes only when it is told to.
        command.args(arguments).env("RUSTC_BOOTSTRAP", "1");
        forget_this_package(&mut command);
        command
    }

    fn targets(&self) -> Result<Vec<String>> {
        let list = run::read(&mut self.command("list", &[]))?;
        Ok(list.lines().map(str::to_owned).collect())
    }

    /// Runs a target; what it learns goes below the target directory, not into the committed corpus.
    fn try_out(&self, target: &str, seconds: u32) -> Result<()> {
        let learnt = self.workspace.target.join("fuzz-corpus").join(target);
        fs::create_dir_all(&learnt).with_context(|| format!("cannot make {}", learnt.display()))?;
        let committed = self.workspace.root.join("fuzz/corpus").join(target);
        let mut command = self.command("run", &[target]);
        command.arg(learnt);
        if committed.is_dir() {
            command.arg(committed);
        }
        command.arg("--").args(LIMITS).arg("-print_final_stats=1");
        run::run(command.arg(format!("-max_total_time={seconds}"))).with_context(|| {
            let again = run::shown(&self.command("run", &[target]));
            format!("again, with the file that is named above: RUSTC_BOOTSTRAP=1 {again} FILE")
        })
    }
}
