//! `normalight render`.
mod sheet;
mod statistics;

use crate::Outcome;
use crate::args::RenderArgs;
use crate::terminal::{note, print};
use crate::{interrupt, progress, scenes};
use anyhow::{Context, Result};
use normalight_io::{
    ObjectToPublish, OutputFolder, PublishedEntry, PublishedPart, PublishedWriter, photograph_png,
};
use normalight_synth::{Framing, Renderer, Sample};
use rayon::prelude::*;
use sheet::Sheet;
use statistics::Statistics;
use std::path::Path;

/// Name of the one material of every rendered shape.
const MATERIAL: &str = "rendered";
/// One in so many stacks is for validation.
const VALIDATION_EVERY: u64 = 100;
/// Stacks on a contact sheet at most.
const SHEET_STACKS: usize = 32;
/// Stacks rendered before the finished ones are written, for each thread.
const AHEAD: usize = 2;

/// Renders, writes and describes stacks.
pub(crate) fn run(args: &RenderArgs) -> Result<Outcome> {
    let renderer = scenes::renderer(&args.recipe, &args.library)?;
    let mut writer = match &args.out {
        // Tried out before the work.
        Some(folder) => Some(PublishedWriter::create(folder)?),
        None => None,
    };
    let mut sheet = args.sheet.then(|| Sheet::new(args.size as usize));
    let mut statistics = args.stats.then(Statistics::default);
    let bar = progress::bar(
        args.count.into(),
        "[{bar:30}] {pos}/{len} stacks  {eta} left",
        args.quiet,
    );
    let numbers: Vec<u64> = (args.first..args.first + u64::from(args.count)).collect();
    let mut written = 0;
    for numbers in numbers.chunks(AHEAD * rayon::current_num_threads()) {
        let samples: Vec<Sample> = numbers
            .par_iter()
            .map(|&number| sample(&renderer, args, number))
            .collect();
        for (&number, sample) in numbers.iter().zip(&samples) {
            if interrupt::asked() {
                break;
            }
            if let Some(writer) = &mut writer {
                write(writer, args, number, sample)?;
            }
            if let Some(sheet) = &mut sheet
                && sheet.len() < SHEET_STACKS
            {
                sheet.add(sample);
            }
            if let Some(statistics) = &mut statistics {
                statistics.add(sample)?;
            }
            written += 1;
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    // An interrupted run leaves whole stacks and lists of them.
    if let Some(writer) = writer {
        writer.finish()?;
    }
    if let (Some(sheet), Some(folder)) = (sheet, &args.out) {
        write_sheet(folder, &sheet)?;
    }
    if interrupt::asked() {
        return Ok(Outcome::Interrupted);
    }
    if let Some(statistics) = statistics {
        print(&statistics.to_text(args.compare.as_deref())?)?;
    }
    if let (Some(folder), false) = (&args.out, args.quiet) {
        note(&format!("{written} stacks in {}", folder.display()));
    }
    Ok(Outcome::Done)
}

fn sample(renderer: &Renderer, args: &RenderArgs, number: u64) -> Sample {
    let (images, size) = (args.images as usize, args.size as usize);
    renderer.sample(number, images, size, Framing::WholeObject)
}

fn write(
    writer: &mut PublishedWriter,
    args: &RenderArgs,
    number: u64,
    sample: &Sample,
) -> Result<()> {
    let entry = PublishedEntry::new(&format!("scene{number:06}"), MATERIAL)?;
    let images = sample.to_stack_images(args.bits.into());
    let object = ObjectToPublish {
        entry: &entry,
        images: &images,
        normals: &sample.to_normal_map(),
        mask: &sample.to_mask(),
        depth: Some(&sample.depth),
        lights: &sample.lights,
    };
    let part = if number % VALIDATION_EVERY == VALIDATION_EVERY - 1 {
        PublishedPart::Validation
    } else {
        PublishedPart::Train
    };
    writer
        .write(&object, part)
        .with_context(|| format!("stack {number}"))
}

fn write_sheet(folder: &Path, sheet: &Sheet) -> Result<()> {
    let picture = photograph_png(&sheet.to_image())?;
    Ok(OutputFolder::prepare(folder)?.write(&[("sheet.png", picture)])?)
}
