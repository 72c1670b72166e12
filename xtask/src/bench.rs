//! How fast the networks are in a browser, beside another runtime.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::{Args, Subcommand};

use crate::packages::Installing;
use crate::run;
use crate::setup::Tools;
use crate::workspace::Workspace;

#[derive(Subcommand)]
pub enum Bench {
    /// The package beside ONNX Runtime in Chromium, on the networks as `normalight export onnx` writes them.
    ///
    /// Takes what `cargo xtask test` or `cargo xtask demo` and a build of the command have left, and builds nothing. Nothing
    /// else should run meanwhile.
    Browser(BrowserArgs),
}

#[derive(Args)]
pub struct BrowserArgs {
    /// How often each is timed, in turns; medians are shown.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// A JSON file for all times.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Time WebGPU on an adapter that the processor imitates, too.
    #[arg(long)]
    software: bool,
}

/// Measures what was asked for.
pub fn run(workspace: &Workspace, bench: &Bench, installing: Installing) -> Result<()> {
    match bench {
        Bench::Browser(args) => browser(workspace, args, installing),
    }
}

fn browser(workspace: &Workspace, args: &BrowserArgs, installing: Installing) -> Result<()> {
    let tools = Tools::new(workspace, installing);
    let node = tools.node()?;
    let chromium = tools.chromium()?;
    let command_line = workspace.command_line();
    let at = |path: &str| workspace.root.join(path);
    let needed = [
        (command_line.clone(), "cargo xtask test --only build"),
        (at("web/wasm/normalight_gpu_bg.wasm"), "cargo xtask wasm"),
        (at("node_modules/onnxruntime-web/package.json"), "npm ci"),
        (at("web/dist/index.js"), "npm run build --workspace web"),
    ];
    for (file, maker) in &needed {
        if !file.is_file() {
            bail!("{} is missing: `{maker}` makes it", file.display());
        }
    }
    let rounds = args.rounds.to_string();
    let arguments = ["run", "--silent", "bench", "--workspace", "web", "--"];
    let mut command = node.npm(workspace, &arguments);
    command.args(["--rounds", &rounds]);
    if let Some(json) = &args.json {
        // npm runs it in another folder.
        let json = std::path::absolute(json).context("--json is no path")?;
        command.arg("--json").arg(json);
    }
    if args.software {
        command.arg("--software");
    }
    command.env("NORMALIGHT_CLI", command_line);
    run::run(command.env("NORMALIGHT_CHROMIUM", chromium))
}
