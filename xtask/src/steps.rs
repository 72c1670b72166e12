//! The steps in their order, each timed; the first that fails ends the run.

use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use clap::ValueEnum;

use crate::lints::{document, lint, own_driver};
use crate::packages::Installing;
use crate::run;
use crate::setup::Tools;
use crate::types;
use crate::wasm;
use crate::wheel;
use crate::workspace::Workspace;

/// One step of the tests or the demo.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Step {
    /// Rust's format.
    Fmt,
    /// Spelling.
    Spelling,
    /// Licences, sources, duplicates and known faults of what is built in.
    Deny,
    /// These tasks themselves: lints, documentation and tests.
    Xtask,
    /// Lints of the native crates with CUDA; only when asked for, since it goes through all dependencies once more.
    Cuda,
    /// The command and the native tests, compiled and linted.
    Build,
    /// The native tests.
    Rust,
    /// The documentation builds without warnings, and its examples run.
    Docs,
    /// Both workflows on this machine, disturbed and not.
    Workflows,
    /// Lints of what runs in the browser.
    WasmClippy,
    /// The WebAssembly modules.
    Wasm,
    /// The modules' JavaScript.
    Bindgen,
    /// The package's generated types are the module's.
    Types,
    /// The page's packages.
    NpmCi,
    /// Types and lints of the page.
    Check,
    /// The page.
    Page,
    /// The package and the page in a browser.
    PageTests,
    /// The package in projects with other tools, which npm fetches.
    Consumers,
}

/// What the demo needs.
pub const DEMO: [Step; 4] = [Step::Wasm, Step::Bindgen, Step::NpmCi, Step::Page];

/// What `web/wasm` needs.
pub const WASM: [Step; 2] = [Step::Wasm, Step::Bindgen];

/// The native crates. All native commands name this one set: Cargo unifies features over the
/// set, and another would compile Burn again. The bindings for the browser build for WebAssembly only;
/// these tasks have their own, cheap profile.
const NATIVE: [&str; 6] = [
    "--release",
    "--workspace",
    "--exclude",
    "normalight-wasm",
    "--exclude",
    "xtask",
];

/// All steps in order, without those left out.
pub fn chosen(only: &[Step], skip: &[Step]) -> Vec<Step> {
    let usual = |step: &Step| only.is_empty() && *step != Step::Cuda;
    let wanted = |step: &&Step| (usual(step) || only.contains(step)) && !skip.contains(step);
    Step::value_variants()
        .iter()
        .filter(wanted)
        .copied()
        .collect()
}

/// Prepares the tools, installing what is missing unless that is forbidden, runs the steps and sums up their times.
pub fn run(workspace: &Workspace, steps: &[Step], installing: Installing) -> Result<()> {
    if steps.is_empty() {
        bail!("no step is left to run");
    }
    let tools = Tools::new(workspace, installing);
    let mut times: Vec<(String, Duration)> = Vec::new();
    let started = Instant::now();
    // Before anything is compiled: what cannot be installed should not come to light at the end.
    prepare(&tools, steps)?;
    times.push(("setup".into(), started.elapsed()));
    for step in steps {
        workspace.say(&format!("{}: {}", step.name(), step.does()));
        let started = Instant::now();
        let result = step.perform(workspace, &tools);
        times.push((step.name(), started.elapsed()));
        if result.is_err() {
            sum_up(workspace, &times);
        }
        result.with_context(|| format!("step {}", step.name()))?;
    }
    sum_up(workspace, &times);
    Ok(())
}

fn sum_up(workspace: &Workspace, times: &[(String, Duration)]) {
    let times: Vec<String> = times
        .iter()
        .map(|(name, time)| format!("{name} {:.1} s", time.as_secs_f64()))
        .collect();
    workspace.say(&times.join(", "));
}

fn prepare(tools: &Tools, steps: &[Step]) -> Result<()> {
    for step in steps {
        match step {
            Step::Fmt | Step::Xtask | Step::Cuda | Step::Build => tools.components()?,
            Step::Wasm => drop(tools.toolchain()?),
            Step::WasmClippy => {
                tools.components()?;
                tools.toolchain()?;
            }
            Step::NpmCi | Step::Check | Step::Page => drop(tools.node()?),
            Step::PageTests | Step::Consumers => {
                tools.node()?;
                tools.chromium()?;
            }
            Step::Rust => drop(tools.software_gpu()?),
            Step::Spelling => drop(tools.typos()?),
            Step::Deny => drop(tools.cargo_deny()?),
            Step::Workflows => drop(tools.engine()?),
            Step::Docs | Step::Bindgen | Step::Types => {}
        }
    }
    Ok(())
}

impl Step {
    fn name(self) -> String {
        self.to_possible_value()
            .map(|value| value.get_name().to_owned())
            .unwrap_or_default()
    }

    fn does(self) -> String {
        self.to_possible_value()
            .and_then(|value| value.get_help().map(ToString::to_string))
            .unwrap_or_default()
    }

    fn perform(self, workspace: &Workspace, tools: &Tools) -> Result<()> {
        let native = |before: &[&str], after: &[&str]| {
            let mut command = workspace.cargo(before);
            command.args(NATIVE).args(after);
            command
        };
        let linted = |before: &[&str], after: &[&str]| {
            let mut command = native(before, after);
            lint(&mut command, &own_driver()?)?;
            anyhow::Ok(command)
        };
        let npm = |arguments: &[&str]| anyhow::Ok(tools.node()?.npm(workspace, arguments));
        match self {
            Self::Fmt => run::run(&mut workspace.cargo(&["fmt", "--all", "--check"])),
            Self::Spelling => wheel::spelling(workspace, tools.typos()?),
            Self::Deny => wheel::deny(workspace, tools.cargo_deny()?),
            Self::Xtask => {
                let lint = ["clippy", "--package", "xtask", "--all-targets", "--"];
                run::run(workspace.cargo(&lint).args(["-D", "warnings"]))?;
                let docs = ["doc", "--no-deps", "--package", "xtask"];
                run::run(workspace.cargo(&docs).env("RUSTDOCFLAGS", "-D warnings"))?;
                run::run(&mut workspace.cargo(&["test", "--package", "xtask"]))
            }
            // Burn's CUDA compiler links LLVM, which its build script would download. Under this variable it leaves LLVM and
            // its C++ alone: enough to check all Rust, not to link.
            Self::Cuda => {
                let after = ["--features", "normalight-cli/cuda", "--all-targets", "--"];
                let mut command = native(&["clippy"], &after);
                run::run(command.args(["-D", "warnings"]).env("DOCS_RS", "1"))
            }
            // With all that the next two steps need, whose features count, too.
            Self::Build => run::run(&mut linted(&["build"], &["--all-targets"])?),
            Self::Rust => {
                let mut command = linted(&["test"], &["--all-targets"])?;
                if *tools.software_gpu()? {
                    // Its tests may not be left out.
                    command.env("NORMALIGHT_SOFTWARE_GPU", "1");
                }
                run::run(&mut command)
            }
            Self::Docs => {
                let mut command = linted(&["test"], &["--doc"])?;
                document(workspace, &mut command)?;
                run::run(&mut command)
            }
            Self::Workflows => tools.engine()?.test(workspace),
            Self::WasmClippy => tools.toolchain()?.clippy(workspace),
            Self::Wasm => tools.toolchain()?.build(workspace),
            Self::Bindgen => wasm::bindgen(workspace),
            Self::Types => types::check(workspace),
            Self::NpmCi => tools.node()?.install_packages(workspace),
            Self::Check => run::run(&mut npm(&["run", "check"])?),
            Self::Page => tools.node()?.build_page(workspace),
            Self::PageTests => {
                let command_line = workspace.command_line();
                if !command_line.is_file() {
                    bail!("{} is missing: step build makes it", command_line.display());
                }
                let mut command = npm(&["test"])?;
                command.env("NORMALIGHT_CLI", command_line);
                run::run(command.env("NORMALIGHT_CHROMIUM", tools.chromium()?))
            }
            Self::Consumers => {
                let mut command = npm(&["run", "test:consumers", "--workspace", "web"])?;
                run::run(command.env("NORMALIGHT_CHROMIUM", tools.chromium()?))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_keep_their_order() {
        let steps = chosen(&[Step::Wasm, Step::Fmt], &[]);
        assert_eq!(steps, [Step::Fmt, Step::Wasm]);
        assert_eq!(chosen(&[], &[]).len(), Step::value_variants().len() - 1);
        assert!(!chosen(&[], &[Step::Docs]).contains(&Step::Docs));
        assert_eq!(chosen(&[Step::Cuda], &[]), [Step::Cuda]);
    }

    #[test]
    fn every_step_says_what_it_does() {
        for step in Step::value_variants() {
            assert!(
                !step.name().is_empty() && !step.does().is_empty(),
                "{step:?}"
            );
        }
    }
}
