//! `vtu2contour contour`: contour lines of a grid.

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result, bail};
use vtu2contour::filter::{Contoured, FilterError, Stage, contour, picture};
use vtu2contour::vtk::{AtomicFile, Selection, VtuFile, write_vtp, write_vtu};

use super::arguments::ContourArguments;
use super::messages::Messages;
use super::stats::{Clock, Stats, Step};

/// The kinds of output.
#[derive(Clone, Copy)]
enum Format {
    Vtp,
    Vtu,
    Svg,
}

/// Runs the job.
pub fn run(arguments: &ContourArguments) -> Result<()> {
    let format = format_of(arguments.output())?;
    let running = &arguments.running;
    if let Some(threads) = running.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(threads))
            .build_global()
            .context("cannot start the threads")?;
    }
    let messages = Messages::new(running.quiet, running.verbose, !running.no_progress);
    let result = job(arguments, format, &messages);
    messages.finish();
    result
}

fn job(arguments: &ContourArguments, format: Format, messages: &Messages) -> Result<()> {
    let mut clock = Clock::start();
    messages.stage("reading");
    let loaded = VtuFile::open(arguments.input())?.read(&Selection::All)?;
    for warning in &loaded.warnings {
        messages.warning(warning);
    }
    let mut progress = |stage: Stage| {
        clock.next(Step::Filter(stage));
        messages.stage(match stage {
            Stage::Field => "taking values and gradients",
            Stage::Interpolant => "building the cubics",
            Stage::Contour => "tracing contours",
            Stage::Data => "carrying data over",
        });
    };
    let contoured = contour(&loaded.data, &arguments.options(), &mut progress)
        .map_err(|error| explained(&error, arguments.input()))?;
    clock.next(Step::Write);
    messages.stage("writing");
    tell(&contoured, messages);
    let stats = Stats::new(&contoured);
    write(arguments, format, contoured)?;
    if let Some(path) = &arguments.output_options.stats {
        write_stats(path, &stats.with_times(clock.stop()))?;
    }
    Ok(())
}

fn format_of(output: &Path) -> Result<Format> {
    match output.extension().and_then(|extension| extension.to_str()) {
        Some("vtp") => Ok(Format::Vtp),
        Some("vtu") => Ok(Format::Vtu),
        Some("svg") => Ok(Format::Svg),
        _ => bail!(
            "cannot write '{}': the output's name must end in .vtp or .vtu (lines) or .svg (a picture)",
            output.display()
        ),
    }
}

/// The error with the file's name; a PDE's with the place marked below.
fn explained(error: &FilterError, input: &Path) -> anyhow::Error {
    match error {
        FilterError::Pde(problem) => anyhow::anyhow!("{error}\n{}", problem.caret()),
        _ => anyhow::anyhow!("'{}': {error}", input.display()),
    }
}

fn write(arguments: &ContourArguments, format: Format, contoured: Contoured) -> Result<()> {
    let options = &arguments.output_options;
    match format {
        Format::Vtp => {
            write_vtp(arguments.output(), &contoured.poly_data, options.write_options())?;
        }
        Format::Vtu => {
            let lines = contoured.poly_data.into_grid();
            write_vtu(arguments.output(), &lines, options.write_options())?;
        }
        Format::Svg => {
            let mut file = AtomicFile::create(arguments.output())?;
            picture(&contoured, options.mesh).write(&mut file)?;
            file.commit()?;
        }
    }
    Ok(())
}

fn write_stats(path: &Path, stats: &Stats) -> Result<()> {
    let mut file = AtomicFile::create(path)?;
    serde_json::to_writer_pretty(&mut file, stats)?;
    writeln!(file)?;
    Ok(file.commit()?)
}

/// Tells what was done, and what could not be.
fn tell(contoured: &Contoured, messages: &Messages) {
    let Contoured { lines, report, .. } = contoured;
    for warning in &report.warnings {
        messages.warning(warning);
    }
    let gradient = report.gradient.as_deref().map_or("recovered".to_owned(), |n| format!("'{n}'"));
    let closed = lines.lines.iter().filter(|line| line.closed).count();
    messages.detail(&format!(
        "array '{}', gradient {gradient}, range {} to {}\n\
         {} triangles; {} active at {} levels, {} subdivided, {} unresolved\n\
         tolerance {:e}, spacing {:e}\n\
         {} lines ({closed} closed), {} points",
        report.label,
        report.range[0],
        report.range[1],
        report.triangles,
        report.counts.active,
        lines.levels.len(),
        report.counts.divided,
        report.counts.unresolved,
        report.resolution.tolerance,
        report.resolution.spacing,
        lines.lines.len(),
        lines.points.len(),
    ));
}
