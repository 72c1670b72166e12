//! Writes seeds for the targets that take bytes as they are, into the folder given: `seeds FOLDER`.
//! Targets with structured inputs need none: every sequence of bytes is a file to them.
#[path = "../../../crates/normalight-io/tests/io/common/archives.rs"]
#[allow(dead_code, clippy::unwrap_used)]
mod archives;
#[path = "../../../crates/normalight-io/tests/io/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;
mod pictures;

use archives::all_ways;
use meshes::{CUBE_OBJ, PlyKind, cube_binary, cube_json, cube_ply};
use normalight_io::NamedBytes;
use normalight_synth::{Preset, Renderer};
use std::path::Path;
use std::{env, fs, io};

/// Name of a target, name of a seed, content.
type Seed = (&'static str, String, Vec<u8>);

fn main() -> io::Result<()> {
    let folder = env::args_os()
        .nth(1)
        .ok_or_else(|| io::Error::other("usage: seeds FOLDER"))?;
    let mut seeds = pictures::seeds();
    seeds.extend(light_files());
    seeds.extend(others());
    for (target, name, content) in &seeds {
        let folder = Path::new(&folder).join(target);
        fs::create_dir_all(&folder)?;
        fs::write(folder.join(format!("seed-{name}")), content)?;
    }
    println!("{} seeds", seeds.len());
    Ok(())
}

fn light_files() -> Vec<Seed> {
    let texts = [
        "3\na1.png 0 0 1\n\"b 2.png\"\t0.1,0.2,0.9\nc\\3.png 0,6;0;0,8\n",
        "\u{feff}file,x,y,z,intensity,confidence\r\na1.png,0,0.6,0.8,1.5,0.5\r\nb 2.png,0,0,1,1,1\r\n",
        "name;azimuth (deg);elevation (deg)\na1.png;90;45,5\nb 2.png;180;30\n",
        "img\tphi\ttheta\na1.png\t0.5\t0.7\n",
        "1 0 0 1\n2 0.1 0.2 0.9\n3 -0.1 0.2 0.9\n",
        "# light\n0 0 1\n0.1 0.2 0.9\n1e-1 -.5 \u{2212}0.5\n",
        "a1.png 0 0 1 0.5 0.6 0.7\nb 2.png 0 0 1 2\n",
    ];
    let mut seeds: Vec<Seed> = Vec::new();
    for (file, text) in texts.iter().enumerate() {
        for count in [2, 3, 6] {
            // The first bytes choose the file's name and the number of photographs.
            let content = [&[file as u8 % 3, count][..], text.as_bytes()].concat();
            seeds.push(("lights", format!("{file}-{count}"), content));
        }
    }
    let wide: Vec<u8> = texts[0].encode_utf16().flat_map(u16::to_le_bytes).collect();
    seeds.push((
        "lights",
        "wide".into(),
        [&[0, 3, 0xFF, 0xFE][..], &wide].concat(),
    ));
    for (name, head, size) in [
        (
            "f8",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (4, 3), }\n",
            8,
        ),
        (
            "f4",
            "{'descr': '>f4', 'fortran_order': True, 'shape': (3, 4), }\n",
            4,
        ),
        (
            "record",
            "{'descr': [('x', '<f4', (2, 3)), (\"y\", '|S5')], 'fortran_order': False, 'shape': ()}",
            29,
        ),
    ] {
        let numbers: Vec<u8> = (0..12 * size).map(|k| 0x3F ^ (k as u8 % 5)).collect();
        seeds.push(("npy", name.into(), parted(head.as_bytes(), &numbers)));
    }
    let text = "a.png 0 0 1\nb.png 0.1 0.2 0.9 1.5\nc.png 0 1 1 0.5 0.6 0.7\n";
    seeds.push(("published", "list".into(), text.into()));
    seeds
}

fn others() -> Vec<Seed> {
    let mut seeds: Vec<Seed> = vec![("obj", "cube".into(), CUBE_OBJ.into())];
    for kind in [PlyKind::Ascii, PlyKind::Little, PlyKind::Big] {
        seeds.push((
            "ply",
            format!("{kind:?}").to_lowercase(),
            cube_ply(kind, "float", "vertex_indices"),
        ));
    }
    let nodes = [
        r#"[{"mesh":0}]"#,
        r#"[{"children":[1],"scale":[1,-1,2]},{"mesh":0,"translation":[1,2,3],"rotation":[0,0,0,1]}]"#,
        r#"[{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1]}]"#,
    ];
    for (place, nodes) in nodes.iter().enumerate() {
        let content = parted(cube_json(nodes).as_bytes(), &cube_binary());
        seeds.push(("glb", format!("cube-{place}"), content));
    }
    seeds.push(("mat", "array".into(), matlab_array()));
    let files = ["v/1.png", "v/2.png", "v/3.png", "mask.png"].map(|name| NamedBytes {
        name: name.to_owned(),
        bytes: name.repeat(9).into_bytes(),
    });
    for (place, (name, bytes)) in all_ways(&files).into_iter().enumerate() {
        let kind = if name.ends_with("zip") { 0 } else { 1 + u8::from(name.ends_with("gz")) };
        seeds.push(("archive", place.to_string(), [&[kind][..], &bytes].concat()));
    }
    let renderer = Renderer::new(Preset::World.recipe()).expect("the preset is sound");
    let scene = renderer
        .whole_scene(1, 3, 8)
        .to_bytes()
        .expect("a small scene");
    let length = u64::from_le_bytes(scene[..8].try_into().expect("eight bytes"));
    let (header, numbers) = scene[8..].split_at(length as usize);
    seeds.push(("scene", "world".into(), parted(header, numbers)));
    let recipe = "preset = \"world\"\n[materials]\nmeasured_share = 0.0\n[shapes]\nmesh = 0.0\nsphere = 1.5\n";
    seeds.push(("recipe", "world".into(), recipe.into()));
    let genotype = include_str!("../../../models/genotypes/paper.json");
    seeds.push(("genotype", "paper".into(), genotype.into()));
    seeds
}

/// `normalight_fuzz::two_parts` takes this apart.
fn parted(first: &[u8], second: &[u8]) -> Vec<u8> {
    let length = (first.len() as u16).to_le_bytes();
    [&length, first, second].concat()
}

/// `Normal_gt`, 2 x 2 x 3 numbers, without the file's head.
fn matlab_array() -> Vec<u8> {
    let element = |kind: u32, content: &[u8]| -> Vec<u8> {
        let mut element = [kind.to_le_bytes(), (content.len() as u32).to_le_bytes()].concat();
        element.extend(content);
        element.resize(element.len().next_multiple_of(8), 0);
        element
    };
    let size: Vec<u8> = [2u32, 2, 3]
        .into_iter()
        .flat_map(u32::to_le_bytes)
        .collect();
    let numbers: Vec<u8> = (0..12).flat_map(|k| f64::from(k).to_le_bytes()).collect();
    let parts = [
        element(6, &[6, 0, 0, 0, 0, 0, 0, 0]),
        element(5, &size),
        element(1, b"Normal_gt"),
        element(9, &numbers),
    ];
    element(14, &parts.concat())
}
