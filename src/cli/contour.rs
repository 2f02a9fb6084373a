//! `vtu2contour contour`: contour lines of a grid.

use std::io::Write;
use std::path::{Path, PathBuf};

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
    check_names(arguments)?;
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
    // a folder that is missing is better told before the work than after
    let stats_file = arguments.output_options.stats.as_ref().map(AtomicFile::create).transpose()?;
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
    if let Some(file) = stats_file {
        write_stats(file, &stats.with_times(clock.stop()))?;
    }
    Ok(())
}

/// Refuses to write over what is read, or two files under one name.
fn check_names(arguments: &ContourArguments) -> Result<()> {
    let written = [Some(arguments.output()), arguments.output_options.stats.as_deref()];
    let mut taken = vec![real_name(arguments.input())];
    for path in written.into_iter().flatten() {
        let name = real_name(path);
        if taken.contains(&name) {
            bail!("'{}' would be written over: give another name", path.display());
        }
        taken.push(name);
    }
    Ok(())
}

/// The name of a file without links and dots, as far as it exists.
fn real_name(path: &Path) -> PathBuf {
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let whole = path.canonicalize().ok();
    let in_folder = || Some(folder.canonicalize().ok()?.join(path.file_name()?));
    whole.or_else(in_folder).unwrap_or_else(|| path.to_owned())
}

fn format_of(output: &Path) -> Result<Format> {
    let extension = output.extension().and_then(|extension| extension.to_str());
    match extension.map(str::to_lowercase).as_deref() {
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

fn write_stats(mut file: AtomicFile, stats: &Stats) -> Result<()> {
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
    let closed = lines.lines.iter().filter(|line| line.closed).count();
    messages.detail(&format!(
        "array '{}', gradient {}, range {:?} to {:?}\n\
         {} triangles; {} active at {} levels, {} subdivided, {} unresolved\n\
         tolerance {:e}, spacing {:e}\n\
         {} lines ({closed} closed), {} points",
        report.label,
        report.gradient,
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
