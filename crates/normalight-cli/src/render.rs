//! `normalight render`.
mod sheet;
mod statistics;

use crate::Outcome;
use crate::args::RenderArgs;
use crate::terminal::{note, print};
use crate::{interrupt, progress, scenes};
use anyhow::{Context, Result, bail};
use normalight_io::{
    ObjectToPublish, OutputFolder, PublishedEntry, PublishedPart, PublishedWriter, photograph_png,
};
use normalight_synth::{Framing, Renderer, Sample};
use rayon::prelude::*;
use sheet::ContactSheet;
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
/// Most memory for the stacks in work.
const MOST_BYTES: u64 = 2_000_000_000;

/// Renders, writes and describes stacks.
pub(crate) fn run(args: &RenderArgs) -> Result<Outcome> {
    let renderer = scenes::renderer(&args.recipe, &args.library)?;
    let mut writer = match &args.out {
        // Tried out before the work.
        Some(folder) => Some(PublishedWriter::create(folder)?),
        None => None,
    };
    check_size(args)?;
    let bar = progress::bar(
        args.count.into(),
        "[{bar:30}] {pos}/{len} stacks  {eta} left",
        args.quiet,
    );
    let end = args
        .first
        .checked_add(args.count.into())
        .context("--first and --count: numbers end at 18446744073709551615")?;
    let mut done = Stacks {
        written: 0,
        sheet: args.sheet.then(|| ContactSheet::new(args.size as usize)),
        statistics: args.stats.then(Statistics::default),
    };
    let worked: Result<()> = (args.first..end)
        .step_by(ahead(args))
        .take_while(|_| !interrupt::asked())
        .try_for_each(|first| {
            let numbers = first..end.min(first + ahead(args) as u64);
            let samples: Vec<Sample> = numbers
                .clone()
                .into_par_iter()
                .map(|number| sample(&renderer, args, number))
                .collect();
            for (number, sample) in numbers.zip(&samples) {
                done.take(args, writer.as_mut(), number, sample)?;
                bar.inc(1);
            }
            Ok(())
        });
    bar.finish_and_clear();
    // An interrupted or failed run leaves whole stacks and lists of them.
    let listed = match writer {
        Some(writer) if worked.is_ok() || done.written > 0 => writer.finish(),
        _ => Ok(()),
    };
    worked.and(listed.map_err(anyhow::Error::from))?;
    if let (Some(sheet), Some(folder)) = (&done.sheet, &args.out) {
        write_sheet(folder, sheet)?;
    }
    if interrupt::asked() {
        return Ok(Outcome::Interrupted);
    }
    if let Some(statistics) = &done.statistics {
        print(&statistics.to_text(args.compare.as_deref())?)?;
    }
    if let (Some(folder), false) = (&args.out, args.quiet) {
        note(&format!("{} stacks in {}", done.written, folder.display()));
    }
    Ok(Outcome::Done)
}

/// What becomes of the stacks.
struct Stacks {
    written: usize,
    sheet: Option<ContactSheet>,
    statistics: Option<Statistics>,
}

impl Stacks {
    fn take(
        &mut self,
        args: &RenderArgs,
        writer: Option<&mut PublishedWriter>,
        number: u64,
        sample: &Sample,
    ) -> Result<()> {
        if let Some(writer) = writer {
            write(writer, args, number, sample)?;
        }
        if let Some(sheet) = &mut self.sheet
            && sheet.len() < SHEET_STACKS
        {
            sheet.add(sample);
        }
        if let Some(statistics) = &mut self.statistics {
            statistics
                .add(sample)
                .with_context(|| format!("stack {number}"))?;
        }
        self.written += 1;
        Ok(())
    }
}

/// Bytes of one stack in memory.
fn bytes(args: &RenderArgs) -> u64 {
    u64::from(args.images) * 3 * u64::from(args.size) * u64::from(args.size) * 4
}

/// Stacks rendered together.
fn ahead(args: &RenderArgs) -> usize {
    let wanted = AHEAD * rayon::current_num_threads();
    // The light of every lamp is held beside the photographs.
    let affordable = MOST_BYTES / (2 * bytes(args));
    wanted.min(affordable.max(1) as usize)
}

fn check_size(args: &RenderArgs) -> Result<()> {
    if 2 * bytes(args) > MOST_BYTES {
        bail!(
            "{} images of {} pixels a side take {:.1} GB in memory, at most {:.1} GB are allowed",
            args.images,
            args.size,
            2e-9 * bytes(args) as f64,
            1e-9 * MOST_BYTES as f64
        );
    }
    Ok(())
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

fn write_sheet(folder: &Path, sheet: &ContactSheet) -> Result<()> {
    let picture = photograph_png(&sheet.to_image())?;
    Ok(OutputFolder::prepare(folder)?.write(&[("sheet.png", picture)])?)
}
