//! Prints how the photographs of folders lie over each other, in numbers.
use normalight_core::register_shots;
use normalight_io::{ReadOptions, read_paths};

fn main() {
    for folder in std::env::args().skip(1) {
        let input = match read_paths(&[folder.clone().into()], &ReadOptions::default()) {
            Ok(input) => input,
            Err(error) => {
                println!("{folder}: error: {error}");
                continue;
            }
        };
        let found = register_shots(&input.stack, &input.mask);
        let moved = |&(_, shot): &(usize, &normalight_core::ShotShift)| shot.certainty > 3.0;
        let moved: Vec<String> = found
            .shifts
            .iter()
            .enumerate()
            .filter(moved)
            .map(|(k, shot)| format!("{k}:{:.2}/{:.1}", shot.pixels(), shot.certainty))
            .collect();
        let most = found
            .shifts
            .iter()
            .map(|shot| shot.pixels())
            .fold(0.0, f32::max);
        let groups: Vec<usize> = found.groups.iter().map(Vec::len).collect();
        let area = input
            .mask
            .bounding_box()
            .map(|area| [area.width, area.height]);
        println!(
            "{folder}: object {area:?} most {most:.2} moved [{}] groups {groups:?}",
            moved.join(" ")
        );
        for notice in &input.plan.notices {
            println!("    {notice}");
        }
    }
}
