//! The engine of `workflows/` and its tests: Python packages in an environment of their own, and Slurm.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::packages::{Installing, Packages};
use crate::run;
use crate::workspace::Workspace;

/// What a Slurm on one machine is made of, as Debian packs it.
const SLURM: [&str; 2] = ["slurm-wlm", "munge"];

/// What asks Python whether it is one that the engine runs on.
const NEW_ENOUGH: &str = "import sys; sys.exit(sys.version_info < (3, 11))";

/// Snakemake as `workflows/requirements.txt` names it.
pub struct Engine {
    python: PathBuf,
}

impl Engine {
    /// Finds the environment below the target directory; makes it where it is missing or made of other requirements.
    pub fn find(workspace: &Workspace, packages: &Packages) -> Result<Self> {
        let home = workspace.target.join("tools/workflows");
        let python = home.join("bin/python");
        let requirements = workspace.root.join("workflows/requirements.txt");
        let wanted = fs::read_to_string(&requirements)
            .with_context(|| format!("cannot read {}", requirements.display()))?;
        // Programs in it know where it lies, so it is not made aside and moved: this comes last instead.
        let stamp = home.join("requirements.txt");
        if fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) {
            return Ok(Self { python });
        }
        if !run::works("python3", &["-c", NEW_ENOUGH]) {
            bail!(
                "the workflows' engine needs Python 3.11 or later as python3; install it by hand"
            );
        }
        if !run::works("python3", &["-c", "import ensurepip, venv"]) {
            packages.install(&["python3-venv"])?;
        }
        let mut make = Command::new("python3");
        make.args(["-m", "venv", "--clear"]).arg(&home);
        let mut install = Command::new(&python);
        install.args(["-m", "pip", "install", "--requirement"]);
        install.arg(&requirements);
        packages.announce(&run::shown(&install))?;
        run::read(&mut make)?;
        run::read(&mut install)?;
        fs::write(&stamp, wanted).with_context(|| format!("cannot write {}", stamp.display()))?;
        Ok(Self { python })
    }

    /// Both workflows on this machine, against plain calls of the command.
    pub fn test(&self, workspace: &Workspace) -> Result<()> {
        let mut command = self.python(workspace)?;
        run::run(command.arg("."))
    }

    /// Python in the folder of the workflows' tests.
    fn python(&self, workspace: &Workspace) -> Result<Command> {
        let command_line = workspace.command_line();
        if !command_line.is_file() {
            bail!("{} is missing: step build makes it", command_line.display());
        }
        let mut command = Command::new(&self.python);
        command
            .current_dir(workspace.root.join("workflows/tests"))
            .env("NORMALIGHT_CLI", command_line)
            // What Python compiles would lie among the sources.
            .env("PYTHONDONTWRITEBYTECODE", "1");
        Ok(command)
    }
}

/// Starts a Slurm of two nodes on this machine, and has it do a tree of captures while a job is cancelled and a node's
/// daemon goes away.
pub fn slurm(workspace: &Workspace, installing: Installing) -> Result<()> {
    let packages = Packages::new(workspace, installing);
    if !SLURM.iter().all(|name| packages.installed(&[name])) {
        packages
            .install(&SLURM)
            .context("the workflows are tested on a Slurm of their own")?;
    }
    let engine = Engine::find(workspace, &packages)?;
    let mut command = engine.python(workspace)?;
    workspace.say("slurm: two nodes on this machine");
    run::run(command.arg("slurm.py"))
}
