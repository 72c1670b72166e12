//! The package's TypeScript types of what crosses into JavaScript: generated from the Rust types by tsify, which
//! leaves them among the module's declarations.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};

use crate::workspace::Workspace;

const HEAD: &str = "\
// Generated from the Rust types by `cargo xtask wasm`; their comments are those of the Rust types.
// Changes by hand are lost: change the Rust types.
";

/// Types that are of use to the worker alone: for loading the module and for handing in files and callbacks.
const OF_THE_WORKER: [&str; 5] = [
    "InitInput",
    "InitOutput",
    "SyncInitInput",
    "InputFile",
    "ProgressCallback",
];

/// Fails unless the package's types are those of the module in web/wasm.
pub fn check(workspace: &Workspace) -> Result<()> {
    let file = generated(workspace);
    let found = fs::read_to_string(&file).unwrap_or_default();
    if found != declared(workspace)? {
        bail!("{} is stale: `cargo xtask wasm` renews it", file.display());
    }
    Ok(())
}

/// Writes the types of the module in web/wasm into the package.
pub fn renew(workspace: &Workspace) -> Result<()> {
    let (file, text) = (generated(workspace), declared(workspace)?);
    // A file that is right keeps its time, so nothing is built again for it.
    if fs::read_to_string(&file).is_ok_and(|found| found == text) {
        return Ok(());
    }
    workspace.say(&format!("types: writing {}", file.display()));
    fs::write(&file, text).with_context(|| format!("cannot write {}", file.display()))
}

fn generated(workspace: &Workspace) -> PathBuf {
    workspace.root.join("web/src/generated.ts")
}

fn declared(workspace: &Workspace) -> Result<String> {
    let file = workspace.root.join("web/wasm/normalight.d.ts");
    let text = fs::read_to_string(&file)
        .with_context(|| format!("{} is missing: `cargo xtask wasm` makes it", file.display()))?;
    let mut types = type_declarations(&text);
    if types.is_empty() {
        bail!("{} declares no types", file.display());
    }
    types.retain(|(name, _)| !OF_THE_WORKER.contains(&name.as_str()));
    // The linker's order is not to be relied on.
    types.sort();
    let types: Vec<String> = types.into_iter().map(|(_, text)| text).collect();
    Ok(format!("{HEAD}\n{}", types.join("\n")))
}

/// Interfaces and types with the comments before them, each with its name.
fn type_declarations(text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut comment = String::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let kind = ["export interface ", "export type "]
            .into_iter()
            .find_map(|kind| line.strip_prefix(kind));
        if let Some(rest) = kind {
            let name = rest.split(|letter: char| !letter.is_alphanumeric());
            let name = name.take(1).collect::<String>();
            let mut item = std::mem::take(&mut comment) + line + "\n";
            if line.ends_with('{') {
                // The brace that ends it stands in the first column.
                for next in lines.by_ref() {
                    item += next;
                    item += "\n";
                    if next.starts_with('}') {
                        break;
                    }
                }
            }
            found.push((name, item));
        } else if line.starts_with("/**") || (!comment.is_empty() && line.starts_with(" *")) {
            comment += line;
            comment += "\n";
        } else {
            comment.clear();
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_told_from_functions() {
        let text = "\
/* eslint-disable */

/**
 * One line.
 */
export interface Light {
    /**
     * In degrees.
     */
    x: { a: number };
}

export type Quality = \"fast\" | \"best\";
/** Of the function. */
export function plan(): Plan;
export interface Plan { images: number[] }
";
        let found = type_declarations(text);
        let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["Light", "Quality", "Plan"]);
        assert!(found[0].1.starts_with("/**\n * One line."));
        assert!(found[0].1.ends_with("a: number };\n}\n"));
        assert_eq!(found[1].1, "export type Quality = \"fast\" | \"best\";\n");
        assert_eq!(found[2].1, "export interface Plan { images: number[] }\n");
    }
}
