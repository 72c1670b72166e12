//! `normalight mesh`.
use crate::args::MeshArgs;
use crate::terminal::print;
use crate::{Outcome, outputs};
use anyhow::Result;
use normalight_core::Mask;
use normalight_io::{
    Derived, DerivedSettings, MeshFileFormat, OutputFolder, decode_mask, derived_files, read_named,
    read_normals,
};

/// Normals in, depth, a mesh and maps out.
pub(crate) fn run(args: &MeshArgs) -> Result<Outcome> {
    let folder = OutputFolder::prepare(&args.out)?;
    let format = args.normal_format.into();
    let file = read_named(&args.normals)?;
    let (normals, found) = read_normals(&file.name, &file.bytes, format)?;
    let mask: Mask = match &args.mask {
        Some(path) => {
            let file = read_named(path)?;
            decode_mask(&file.name, &file.bytes)?
        }
        None => found,
    };
    let mut settings = args.surface.settings(format);
    if !settings.wanted() {
        settings = DerivedSettings {
            mesh: Some(MeshFileFormat::Glb),
            ..settings
        };
    }
    let Derived { files, report, .. } = derived_files(&normals, None, &mask, settings)?;
    folder.write(&files)?;
    if !args.quiet {
        print(&outputs::surface_summary(&report))?;
        let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
        print(&format!(
            "results: {}: {}\n",
            args.out.display(),
            names.join(", ")
        ))?;
    }
    Ok(Outcome::Done)
}
