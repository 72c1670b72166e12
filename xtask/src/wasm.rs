//! The WebAssembly module: its toolchain, its build, its JavaScript.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, anyhow, bail};
use wasm_bindgen_cli_support::Bindgen;

use crate::fresh::stale;
use crate::lints::{lint, own_driver, sysroot};
use crate::packages::Packages;
use crate::run;
use crate::setup::rustup_may_not_install;
use crate::workspace::{Workspace, forget_this_package};

const TARGET: &str = "wasm32-unknown-unknown";
const CRATE: &str = "normalight-wasm";
const PROFILE: &str = "browser";

/// The crate and ours below it.
const LINTED: [&str; 5] = [
    CRATE,
    "normalight-core",
    "normalight-io",
    "normalight-kernels",
    "normalight-model",
];

/// A module: an example of the crate, with the feature that it is built with, and its budget in megabytes (`docs/size.md`).
struct Module {
    name: &'static str,
    feature: &'static str,
    most: f64,
}

const MODULES: [Module; 2] = [
    Module {
        name: "normalight",
        feature: "cpu",
        most: 6.8,
    },
    Module {
        name: "normalight_gpu",
        feature: "gpu",
        most: 19.6,
    },
];

/// Debian's Rust for WebAssembly, with the sources of the standard library and a linker.
const PACKAGES: [&str; 6] = [
    "rustc-web",
    "cargo-web",
    "rust-web-src",
    "rust-web-llvm",
    "rust-web-clippy",
    "lld-22",
];

/// A Rust that can build for the browser.
pub enum Toolchain {
    /// The one that built this program: it has the target's standard library.
    Own,
    /// Debian's packages, beside it: they build the standard library from source.
    Debian,
}

impl Toolchain {
    /// Finds a toolchain; if there is none, asks rustup for the target, then Debian for its packages.
    pub fn find(workspace: &Workspace, packages: &Packages) -> Result<Self> {
        if own_has_target() {
            return Ok(Self::Own);
        }
        if packages.installed(&PACKAGES) && debian_is_new_enough().is_ok() {
            workspace.say("setup: Rust for WebAssembly is Debian's");
            return Ok(Self::Debian);
        }
        if rustup_may_not_install() {
            workspace.say("setup: RUSTUP_AUTO_INSTALL=0, so rustup is not asked for the target");
        } else if rustup_adds_target(packages)? {
            return Ok(Self::Own);
        } else {
            workspace.say("setup: rustup cannot fetch the target; using Debian's packages");
        }
        packages
            .install(&PACKAGES)
            .with_context(|| format!("Rust cannot build for {TARGET}; either `rustup target add {TARGET}`, or Debian's packages"))?;
        debian_is_new_enough()?;
        Ok(Self::Debian)
    }

    fn build_command(&self, workspace: &Workspace) -> Command {
        let mut command = match self {
            Self::Own => workspace.cargo(&["build"]),
            Self::Debian => debian_cargo(workspace),
        };
        command.env("CARGO_TARGET_DIR", workspace.wasm_target());
        // Flags meant for this computer would replace the ones for WebAssembly in .cargo/config.toml.
        for name in [
            "RUSTFLAGS",
            "CARGO_ENCODED_RUSTFLAGS",
            "CARGO_BUILD_RUSTFLAGS",
        ] {
            command.env_remove(name);
        }
        command.args(["--profile", PROFILE, "--target", TARGET, "--package", CRATE]);
        if matches!(self, Self::Debian) {
            command.arg("-Zbuild-std=std,panic_abort");
        }
        command
    }

    /// Lints the bindings for the browser and every crate of ours below it, with the calls banned that the
    /// browser does not have.
    /// Our own crates are built again after it.
    pub fn clippy(&self, workspace: &Workspace) -> Result<()> {
        let driver = match self {
            Self::Own => own_driver()?,
            Self::Debian => PathBuf::from("/usr/bin/clippy-driver"),
        };
        for module in MODULES {
            let mut command = self.build_command(workspace);
            for name in LINTED {
                // What is thrown away need not be fast.
                let quick = format!("profile.{PROFILE}.package.{name}.opt-level=0");
                command.args(["--config", &quick]);
            }
            command
                .args(["--lib", "--features", module.feature])
                .env("CLIPPY_CONF_DIR", workspace.root.join("xtask/clippy-wasm"));
            lint(&mut command, &driver)?;
            run::run(&mut command)?;
        }
        Ok(())
    }

    /// Compiles the modules.
    pub fn build(&self, workspace: &Workspace) -> Result<()> {
        for Module { name, feature, .. } in MODULES {
            let mut command = self.build_command(workspace);
            run::run(command.args(["--example", name, "--features", feature]))?;
        }
        Ok(())
    }
}

fn own_has_target() -> bool {
    sysroot().is_ok_and(|sysroot| {
        sysroot
            .join("lib/rustlib")
            .join(TARGET)
            .join("lib")
            .is_dir()
    })
}

fn rustup_adds_target(packages: &Packages) -> Result<bool> {
    if which::which("rustup").is_err() {
        return Ok(false);
    }
    packages.announce(&format!("rustup target add {TARGET}"))?;
    let mut command = Command::new("rustup");
    command.args(["target", "add", TARGET]);
    // Debian's packages are the second try: no need to wait long for the first.
    for (name, value) in [
        ("RUSTUP_MAX_RETRIES", "0"),
        ("RUSTUP_DOWNLOAD_TIMEOUT", "20"),
    ] {
        if env::var_os(name).is_none() {
            command.env(name, value);
        }
    }
    Ok(run::read(&mut command).is_ok() && own_has_target())
}

/// Debian's cargo with nothing of the toolchain that runs this program: rustup's variables would
/// lead it back to rustup's compiler.
fn debian_cargo(workspace: &Workspace) -> Command {
    let mut command = Command::new("/usr/bin/cargo");
    command.arg("build").current_dir(&workspace.root);
    forget_this_package(&mut command);
    const PREFIXES: [&str; 4] = ["RUSTC", "RUSTDOC", "RUSTUP_", "CARGO_BUILD_RUSTC"];
    for (name, _) in env::vars_os() {
        let Some(text) = name.to_str() else { continue };
        let of_another = PREFIXES.iter().any(|prefix| text.starts_with(prefix));
        if of_another || text == "CARGO_BUILD_TARGET" || text == "LD_LIBRARY_PATH" {
            command.env_remove(text);
        }
    }
    command
        .env("CARGO", "/usr/bin/cargo")
        .env("RUSTC", "/usr/bin/rustc");
    // Building the standard library is a nightly feature; this admits it on a stable compiler.
    command.env("RUSTC_BOOTSTRAP", "1");
    command
}

fn debian_is_new_enough() -> Result<()> {
    let needed = version(env!("CARGO_PKG_RUST_VERSION"))?;
    let text = run::read(Command::new("/usr/bin/rustc").arg("--version"))?;
    let found = version(text.split(' ').nth(1).unwrap_or_default())?;
    if found < needed {
        bail!(
            "Debian's Rust is {}.{}; Normalight needs {}.{}",
            found.0,
            found.1,
            needed.0,
            needed.1
        );
    }
    Ok(())
}

fn version(text: &str) -> Result<(u32, u32)> {
    let mut parts = text.split('.').map(str::parse);
    match (parts.next(), parts.next()) {
        (Some(Ok(major)), Some(Ok(minor))) => Ok((major, minor)),
        _ => Err(anyhow!("`{text}` is no Rust version")),
    }
}

/// The weights that ship, as the package fetches them.
const WEIGHTS: [&str; 2] = ["light.safetensors", "normal.safetensors"];

/// Writes the modules, their JavaScript and the weights for the page into web/wasm, unless they are newer than what they are
/// made of.
pub fn bindgen(workspace: &Workspace) -> Result<()> {
    let built = workspace
        .wasm_target()
        .join(TARGET)
        .join(PROFILE)
        .join("examples");
    let modules = MODULES.map(|Module { name, .. }| built.join(name).with_extension("wasm"));
    if let Some(missing) = modules.iter().find(|module| !module.is_file()) {
        bail!(
            "{} is missing: `cargo xtask wasm` builds it",
            missing.display()
        );
    }
    let shipped = workspace.root.join("models/default");
    let output = workspace.root.join("web/wasm");
    let [cpu, gpu] = &modules;
    // What is written first is the oldest.
    if !stale(&output.join("normalight.js"), &[cpu, gpu, &shipped])? {
        workspace.say("bindgen: web/wasm is up to date");
        return Ok(());
    }
    // Made aside and renamed: who reads web/wasm never meets half of it.
    let aside = workspace.root.join("web/wasm.new");
    remove(&aside)?;
    for (module, Module { name, most, .. }) in modules.iter().zip(MODULES) {
        let mut bindgen = Bindgen::new();
        bindgen.input_path(module).out_name(name).typescript(true);
        // The package names the module's address itself, once: bundlers copy the module for each.
        bindgen.omit_default_module_path(true);
        // Function names are a good part of the module; panics still say their file and line.
        bindgen
            .remove_name_section(true)
            .remove_producers_section(true);
        bindgen
            .web(true)
            .and_then(|web| web.generate(&aside))
            .with_context(|| format!("wasm-bindgen cannot read {}", module.display()))?;
        let written = megabytes(&aside.join(format!("{name}_bg.wasm")))?;
        workspace.say(&format!(
            "bindgen: {name} has {written:.2} MB ({:.2} MB as compiled)",
            megabytes(module)?
        ));
        if written > most {
            bail!("{name} has {written:.2} MB, at most {most} are wanted: see docs/size.md");
        }
    }
    for name in WEIGHTS {
        let (from, to) = (shipped.join(name), aside.join(name));
        fs::copy(&from, &to).with_context(|| format!("cannot copy {}", from.display()))?;
    }
    remove(&output)?;
    fs::rename(&aside, &output).with_context(|| format!("cannot write {}", output.display()))
}

fn remove(folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder)
            .with_context(|| format!("cannot remove {}", folder.display()))?;
    }
    Ok(())
}

fn megabytes(file: &Path) -> Result<f64> {
    let data = fs::metadata(file).with_context(|| format!("cannot read {}", file.display()))?;
    Ok(data.len() as f64 / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rust_versions_are_compared_by_number() {
        assert!(version("1.100.0").unwrap() > version("1.95").unwrap());
        assert_eq!(version("1.96.0-nightly").unwrap(), (1, 96));
        assert!(version("new").is_err());
    }
}
