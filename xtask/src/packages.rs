//! Installing what the system lacks, with the consent of whoever runs this.

use std::cell::Cell;
use std::io::{IsTerminal, stdin};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::run;
use crate::workspace::Workspace;

/// Whether anything may be installed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Installing {
    /// After saying so; at a terminal, after asking.
    Announced,
    /// Never: the command is named instead.
    Forbidden,
}

/// Debian's packages, and everything else that is installed.
pub struct Packages<'a> {
    workspace: &'a Workspace,
    installing: Installing,
    updated: Cell<bool>,
}

impl<'a> Packages<'a> {
    /// Nothing installed yet.
    pub fn new(workspace: &'a Workspace, installing: Installing) -> Self {
        Self {
            workspace,
            installing,
            updated: Cell::new(false),
        }
    }

    /// Says what is about to be run, and asks where somebody sits at a terminal; an error if it may not be.
    pub fn announce(&self, command: &str) -> Result<()> {
        self.allowed(&format!("run it yourself: {command}"))?;
        self.workspace.say(&format!("setup: {command}"));
        if !stdin().is_terminal() {
            return Ok(());
        }
        self.workspace.say("setup: run this? [Y/n]");
        let mut answer = String::new();
        stdin().read_line(&mut answer)?;
        if !agrees(&answer) {
            bail!("not installed; run it yourself: {command}");
        }
        Ok(())
    }

    /// An error, with what to do instead, where nothing may be installed.
    fn allowed(&self, instead: &str) -> Result<()> {
        if self.installing == Installing::Forbidden {
            bail!("nothing may be installed (--no-install); {instead}");
        }
        Ok(())
    }

    /// Whether all of these are installed.
    pub fn installed(&self, names: &[&str]) -> bool {
        let mut command = Command::new("dpkg-query");
        command
            .args(["--show", "--showformat", "${db:Status-Status}\n"])
            .args(names);
        run::read(&mut command).is_ok_and(|text| {
            text.lines().filter(|line| *line == "installed").count() == names.len()
        })
    }

    /// Installs packages, or fails with the command to type.
    pub fn install(&self, names: &[&str]) -> Result<()> {
        let install = format!(
            "apt-get install --yes --no-install-recommends {}",
            names.join(" ")
        );
        let by_hand = format!("install by hand: sudo apt-get update && sudo {install}");
        if which::which("apt-get").is_err() {
            bail!("there is no apt-get here to install {}", names.join(" "));
        }
        self.allowed(&by_hand)?;
        let root = run::read(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0");
        if !root && !run::works("sudo", &["-n", "true"]) {
            bail!("no right to install packages; {by_hand}");
        }
        self.announce(&install)?;
        if !self.updated.replace(true) {
            self.workspace.say("setup: apt-get update");
            // One source out of reach is no reason to stop: the install says what it misses.
            if let Err(error) = run::read(&mut apt(root, &["update"])) {
                self.workspace.say(&format!("setup: {error:#}"));
            }
        }
        let words: Vec<&str> = install.split(' ').skip(1).collect();
        run::read(&mut apt(root, &words))
            .map(|_| ())
            .context(by_hand)
    }
}

fn apt(root: bool, arguments: &[&str]) -> Command {
    let mut command = Command::new(if root { "env" } else { "sudo" });
    if !root {
        command.args(["-n", "env"]);
    }
    command.args([
        "DEBIAN_FRONTEND=noninteractive",
        "apt-get",
        "-o",
        "DPkg::Lock::Timeout=300",
    ]);
    command.args(arguments);
    command
}

/// Whether somebody who was asked agrees; an empty line does.
fn agrees(answer: &str) -> bool {
    matches!(answer.trim().to_lowercase().as_str(), "" | "y" | "yes")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_yes_is_one() {
        for (answer, expected) in [
            ("\n", true),
            ("Y\n", true),
            ("yes\n", true),
            ("n\n", false),
            ("what?\n", false),
        ] {
            assert_eq!(agrees(answer), expected, "{answer:?}");
        }
    }

    #[test]
    fn forbidden_packages_are_named() {
        let workspace = Workspace::find().unwrap();
        let packages = Packages::new(&workspace, Installing::Forbidden);
        let error = packages.install(&["no-such-package-here"]).unwrap_err();
        let text = format!("{error:#}");
        assert!(text.contains("no-such-package-here"), "{text}");
        let error = packages
            .announce("rustup component add clippy")
            .unwrap_err();
        assert!(format!("{error:#}").contains("rustup component add clippy"));
    }
}
