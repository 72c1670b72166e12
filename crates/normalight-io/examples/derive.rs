//! Depth, a mesh and maps of a normal map that was made anywhere:
//! `cargo run --release -p normalight-io --example derive -- normals.png mask.png out [--flatten]`.
use normalight_io::{
    Derived, DerivedSettings, MapSettings, MeshFileFormat, NormalFormat, OutputFolder, decode_mask,
    derived_files, read_normals,
};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [normals_file, mask_file, out, options @ ..] = &arguments[..] else {
        return Err("expected: NORMALS MASK OUT [--flatten]".into());
    };
    let bytes = std::fs::read(normals_file)?;
    let (normals, _) = read_normals(normals_file, &bytes, NormalFormat::OpenGl)?;
    let mask = decode_mask(mask_file, &std::fs::read(mask_file)?)?;
    let settings = DerivedSettings {
        flatten: options.iter().any(|option| option == "--flatten"),
        heights: true,
        mesh: Some(MeshFileFormat::Glb),
        maps: Some(MapSettings::default()),
        ..DerivedSettings::default()
    };
    let Derived { files, report, .. } = derived_files(&normals, None, &mask, settings)?;
    OutputFolder::prepare(Path::new(out))?.write(&files)?;
    println!("{report:#?}");
    Ok(())
}
