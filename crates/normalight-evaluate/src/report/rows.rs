//! What stands in the tables of all reports.
use crate::published::{PUBLISHED, Published};
use crate::table::known;
use crate::{EvaluateError, Figures, Method, NormalFigures, Table, Trial};
use std::cmp::Reverse;

/// A table of words and figures, however it is written.
pub(super) struct Grid {
    pub(super) title: String,
    /// What is to be known of it.
    pub(super) note: String,
    pub(super) heads: Vec<String>,
    /// Number of columns that hold words, from the first.
    pub(super) words: usize,
    pub(super) rows: Vec<GridRow>,
}

pub(super) struct GridRow {
    /// Figures that others published.
    pub(super) published: bool,
    /// The row's name, then as many cells as heads less one.
    pub(super) cells: Vec<String>,
}

/// The names of all objects in the tables, in the order in which they come.
pub(super) fn objects(tables: &[Table]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for table in tables {
        let measured = table.objects.iter().map(|object| object.name.as_str());
        let failed = table.failures.iter().map(|failure| failure.name.as_str());
        for name in measured.chain(failed) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
}

/// Every method and number of photographs in one line each, over all objects.
pub(super) fn summary(tables: &[Table]) -> Grid {
    let heads = [
        "Method",
        "Photographs",
        "Normals",
        "Median",
        "Under 11.25°",
        "Under 22.5°",
        "Under 30°",
        "Lights",
        "Intensities",
        "Seconds",
        "Multiply-adds",
        "Memory",
        "Objects",
    ];
    let share = |share: f64| format!("{:.1} %", 100.0 * share);
    let normals = |mean: &Figures, words: &dyn Fn(NormalFigures) -> String| {
        mean.normals.map_or("-".to_owned(), words)
    };
    let with = |value: String, spread: Option<f64>| match spread {
        Some(spread) => format!("{value} ± {spread:.2}"),
        None => value,
    };
    let whole = tables.iter().filter(|table| table.disturbance.is_none());
    let rows = whole.map(|table| {
        let mut cells = vec![
            table.method.title().to_owned(),
            table
                .images
                .map_or("all".to_owned(), |images| images.to_string()),
        ];
        if let Some(mean) = &table.mean {
            let spread = table.spread;
            cells.extend([
                with(
                    known(mean.normal_degrees(), 2),
                    spread.and_then(|spread| spread.normal_degrees),
                ),
                normals(mean, &|normals| {
                    format!("{:.2}", normals.normal_median_degrees)
                }),
                normals(mean, &|normals| share(normals.under_11_25)),
                normals(mean, &|normals| share(normals.under_22_5)),
                normals(mean, &|normals| share(normals.under_30)),
                with(
                    known(mean.light_degrees, 2),
                    spread.and_then(|spread| spread.light_degrees),
                ),
                known(mean.intensity_error, 3),
                format!("{:.2}", mean.seconds),
                known(mean.multiply_adds.map(|count| count / 1e9), 1),
                known(mean.peak_memory.map(|bytes| bytes / 1e9), 2),
            ]);
        }
        cells.resize(heads.len() - 1, "-".to_owned());
        let measured = table.objects.len();
        cells.push(match table.failures.len() {
            0 => measured.to_string(),
            failed => format!("{measured} of {}", measured + failed),
        });
        GridRow {
            published: false,
            cells,
        }
    });
    Grid {
        title: "All methods".to_owned(),
        note: "Means over the objects, each counting the same: errors of normals and light directions in degrees, relative \
               errors of intensities, shares of pixels whose normal is less than so many degrees off; seconds and most memory of the \
               process (gigabytes) for an object, multiply-adds of its networks (thousand millions). ± is the standard \
               deviation over random choices of photographs."
            .to_owned(),
        rows: rows.collect(),
        words: 1,
        heads: heads.map(str::to_owned).to_vec(),
    }
}

/// Which errors a table of objects lists.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Normals,
    Lights,
}

/// Whether a method has such errors of its own: one that is told the lights has none, and two that take the same lights are
/// one.
pub(super) fn shown(tables: &[Table], table: &Table, quantity: Quantity) -> bool {
    let networks = || {
        tables
            .iter()
            .any(|table| table.method == Method::Uncalibrated)
    };
    match (quantity, table.method) {
        (Quantity::Normals, _) => true,
        (Quantity::Lights, Method::EstimatedLeastSquares) => !networks(),
        (Quantity::Lights, method) => !method.knows_lights(),
    }
}

/// For each number of photographs, the largest first, the errors of the normals and of the lights of every object.
pub(super) fn by_object(tables: &[Table]) -> Vec<Grid> {
    let whole = tables.iter().filter(|table| table.disturbance.is_none());
    let mut counts: Vec<Option<usize>> = whole.map(|table| table.images).collect();
    // `None`, all of them, is the most.
    counts.sort_by_key(|count| Reverse(count.unwrap_or(usize::MAX)));
    counts.dedup();
    let both = [Quantity::Normals, Quantity::Lights];
    let of_count = |images| both.map(|quantity| of_quantity(tables, images, quantity));
    counts.into_iter().flat_map(of_count).collect()
}

/// One number of photographs, a line for each method and a column for each object, published methods beside ours.
fn of_quantity(tables: &[Table], images: Option<usize>, quantity: Quantity) -> Grid {
    let names = objects(tables);
    let mut heads = vec!["Method".to_owned()];
    heads.extend(names.iter().map(|&name| name.to_owned()));
    heads.push("Mean".to_owned());
    let of_it = || {
        let all = tables.iter();
        all.filter(|table| table.images == images && table.disturbance.is_none())
    };
    let mut rows: Vec<GridRow> = of_it()
        .filter(|table| shown(tables, table, quantity))
        .map(|table| {
            let value = |figures: &Figures| match quantity {
                Quantity::Normals => figures.normal_degrees(),
                Quantity::Lights => figures.light_degrees,
            };
            let measured = |name: &str| table.objects.iter().find(|object| object.name == name);
            let mut cells = vec![table.method.title().to_owned()];
            cells.extend(names.iter().map(|name| {
                measured(name).map_or("failed".to_owned(), |object| {
                    known(value(&object.figures), 2)
                })
            }));
            // Over all of them or not at all: a mean of the easier ones would deceive.
            let mean = table.mean.as_ref().filter(|_| table.failures.is_empty());
            cells.push(known(mean.and_then(value), 2));
            GridRow {
                published: false,
                cells,
            }
        })
        .collect();
    let most = of_it().flat_map(|table| table.objects.iter().map(|object| object.images));
    // Published figures are of all 96 photographs.
    if most.max() == Some(96) {
        rows.extend(
            PUBLISHED
                .iter()
                .filter_map(|one| published(one, &names, quantity)),
        );
    }
    let (what, rest) = match quantity {
        Quantity::Normals => ("normals", ""),
        Quantity::Lights => ("light directions", ", of methods that are not told them"),
    };
    let count = images.map_or("all photographs".to_owned(), |images| {
        format!("{images} photographs")
    });
    let mut note = format!("Mean angular errors in degrees{rest}.");
    if rows.iter().any(|row| row.published) {
        note += " Published figures are of all 96 photographs, their means here of the objects in this table.";
    }
    Grid {
        title: format!("Errors of the {what}, {count}"),
        note,
        heads,
        words: 1,
        rows,
    }
}

/// The line of a published method; none where it says nothing of these objects.
fn published(one: &Published, names: &[&str], quantity: Quantity) -> Option<GridRow> {
    let values = match quantity {
        Quantity::Normals => one.normals,
        Quantity::Lights => one.lights,
    };
    let figures = names.iter().map(|name| Published::of(values, name));
    let mut cells = vec![one.name.to_owned()];
    cells.extend(figures.map(|figure| known(figure, 2)));
    let mean = Published::mean(values, names.iter().copied());
    cells.push(known(mean, 2));
    cells[1..]
        .iter()
        .any(|cell| cell != "-")
        .then_some(GridRow {
            published: true,
            cells,
        })
}

/// What disturbed photographs cost.
pub(super) fn disturbed(tables: &[Table]) -> Grid {
    let heads = [
        "Photographs",
        "Method",
        "Normals",
        "Normals, more than undisturbed",
        "Lights",
        "Lights, more than undisturbed",
    ];
    let more = |value: Option<f64>, before: Option<f64>| {
        let difference = value.zip(before).map(|(value, before)| value - before);
        difference.map_or("-".to_owned(), |difference| format!("{difference:+.2}"))
    };
    let rows = tables.iter().filter_map(|table| {
        let words = table.disturbance?.words();
        let before = tables.iter().find(|one| {
            (one.method, one.images, one.disturbance) == (table.method, table.images, None)
        });
        // Means of other objects would say nothing of the disturbance.
        let whole = |table: &Table| table.mean.filter(|_| table.failures.is_empty());
        let (mean, before) = (whole(table), before.and_then(whole));
        let normals = mean.and_then(|mean| mean.normal_degrees());
        let lights = mean.and_then(|mean| mean.light_degrees);
        Some(GridRow {
            published: false,
            cells: vec![
                words,
                table.method.title().to_owned(),
                known(normals, 2),
                more(normals, before.and_then(|mean| mean.normal_degrees())),
                known(lights, 2),
                more(lights, before.and_then(|mean| mean.light_degrees)),
            ],
        })
    });
    Grid {
        title: "Disturbed photographs".to_owned(),
        note: "What goes wrong in practice, done to the photographs of the benchmark. Mean angular errors in degrees."
            .to_owned(),
        rows: rows.collect(),
        words: 2,
        heads: heads.map(str::to_owned).to_vec(),
    }
}

/// Every trial in one line.
pub(super) fn csv(trials: &[Trial]) -> Result<Vec<u8>, EvaluateError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: csv::Error| EvaluateError::Report(error.to_string());
    writer
        .write_record([
            "object",
            "method",
            "images_asked",
            "subset",
            "disturbance",
            "images",
            "pixels",
            "without_truth",
            "normal_degrees",
            "normal_median_degrees",
            "under_11_25",
            "under_22_5",
            "under_30",
            "light_degrees",
            "intensity_error",
            "seconds",
            "multiply_adds",
            "peak_memory_bytes",
            "failure",
        ])
        .map_err(failed)?;
    let number = |value: Option<u64>| value.map_or(String::new(), |value| value.to_string());
    // What follows says nothing, and would differ where figures come from files.
    let real = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.6}"));
    let whole = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.0}"));
    for trial in trials {
        let measured = trial.result.as_ref().ok();
        let count = |value: fn(&crate::ObjectFigures) -> usize| {
            number(measured.map(|object| value(object) as u64))
        };
        let figures = measured.map(|object| &object.figures);
        let normals = figures.and_then(|figures| figures.normals);
        let normal = |value: fn(NormalFigures) -> f64| real(normals.map(value));
        writer
            .write_record([
                trial.object.clone(),
                trial.method.name().to_owned(),
                number(trial.photographs.images.map(|images| images as u64)),
                number(trial.photographs.subset),
                trial
                    .photographs
                    .disturbance
                    .map(|one| one.to_string())
                    .unwrap_or_default(),
                count(|object| object.images),
                count(|object| object.pixels),
                count(|object| object.without_truth),
                normal(|normals| normals.normal_degrees),
                normal(|normals| normals.normal_median_degrees),
                normal(|normals| normals.under_11_25),
                normal(|normals| normals.under_22_5),
                normal(|normals| normals.under_30),
                real(figures.and_then(|figures| figures.light_degrees)),
                real(figures.and_then(|figures| figures.intensity_error)),
                real(figures.map(|figures| figures.seconds)),
                whole(figures.and_then(|figures| figures.multiply_adds)),
                whole(figures.and_then(|figures| figures.peak_memory)),
                trial.result.as_ref().err().cloned().unwrap_or_default(),
            ])
            .map_err(failed)?;
    }
    writer
        .into_inner()
        .map_err(|error| EvaluateError::Report(error.to_string()))
}
