//! Says what in a tree is a capture, and how long finding that took: `cargo run --release --example walk -- ROOT`. With
//! `--make FOLDERS FILES` the tree is made before, of empty files with names of photographs.
use normalight_batch::find_captures;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let root = Path::new(arguments.first().ok_or("expected ROOT")?);
    let is_made = arguments.get(1).is_some_and(|word| word == "--make");
    if let (true, Some(folders), Some(files)) = (is_made, arguments.get(2), arguments.get(3)) {
        let files: usize = files.parse()?;
        for folder in 0..folders.parse()? {
            let place = root.join(format!("room {}/object {folder}", folder % 40));
            std::fs::create_dir_all(&place)?;
            for file in 0..files {
                std::fs::write(place.join(format!("IMG_{file:04}.jpg")), "")?;
            }
        }
    }
    let start = Instant::now();
    let found = find_captures(root)?;
    let seconds = start.elapsed().as_secs_f64();
    if !is_made {
        for line in found.lines(false) {
            println!("{line}");
        }
    }
    println!(
        "{} captures in {} folders, {} passed over, {seconds:.2} s",
        found.captures.len(),
        found.folders,
        found.passed_over.len(),
    );
    Ok(())
}
