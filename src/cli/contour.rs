//! `vtu2contour contour`: contour lines of a grid, of its pieces, or of a series.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};
use vtu2contour::contour::Levels;
use vtu2contour::contour::surface::Fineness;
use vtu2contour::filter::{
    ContourOptions, Contoured, Extent, FilterError, Stage, contour_owned, preview, renumber_cells,
};
use vtu2contour::vtk::{AtomicFile, PvdEntry, UnstructuredGrid};

use super::arguments::ContourArguments;
use super::cell_numbers::CellCounter;
use super::input::{Arrays, Input, Part};
use super::messages::Messages;
use super::output::{Format, Output, listed_file};
use super::running;
use super::stats::{Clock, Stats, Step};
use super::warnings::Warnings;

/// Runs the job.
pub fn run(arguments: &ContourArguments) -> Result<()> {
    let format = Format::of(arguments.output())?;
    running::run(&arguments.running, |messages| write_contours(arguments, format, messages))
}

fn write_contours(arguments: &ContourArguments, format: Format, messages: &Messages) -> Result<()> {
    let clock = Clock::start();
    messages.stage("opening");
    let input = open(arguments, format)?;
    check_names(arguments, format, &input)?;
    // a folder that is missing is better told before the work than after
    let stats_file = arguments.output_options.stats.as_ref().map(AtomicFile::create).transpose()?;
    let options = &arguments.output_options;
    let mut output = Output::begin(arguments.output(), options.write_options(), options.mesh)?;
    let mut job = Job {
        input: &input,
        options: arguments.options(),
        has_data: format.has_data(),
        messages,
        clock,
        warnings: Warnings::default(),
        stats: Stats::default(),
        counter: input.whole().filter(|_| format.joins_pieces()).map(CellCounter::new),
        nothing: None,
    };
    let result = job.run(&mut output);
    job.warnings.lines(input.parts.len()).for_each(|line| messages.warning(&line));
    result?;
    let stats = stats_file.map(|file| job.stats.write(file, job.clock.stop())).transpose()?;
    output.finish()?;
    stats.map_or(Ok(()), |file| Ok(file.commit()?))
}

/// Opens the input, and refuses output that cannot hold all of it.
fn open(arguments: &ContourArguments, format: Format) -> Result<Input> {
    let time = arguments.scalars.time;
    let stream = arguments.stream;
    let input = Input::open(arguments.input(), time, stream || format == Format::Pvtp)?;
    let (path, count) = (arguments.input().display(), input.parts.len());
    if !input.is_series() || !input.is_several() || format == Format::Pvd {
        if stream && input.is_series() {
            bail!(
                "'{path}' is a series, of which files are taken one at a time: --stream is for the \
                 pieces of one, with --time T and -o NAME.vtp"
            );
        }
        if stream && !format.joins_pieces() && format != Format::Pvtp {
            bail!("--stream is for .vtp, .vtu and .pvtp: leave it out, or write one of these");
        }
        return Ok(input);
    }
    match time {
        None => bail!(
            "'{path}' is a series of {count} files: write a series, with -o NAME.pvd, or choose a \
             step, with --time T, first or last"
        ),
        Some(_) => bail!("'{path}' has {count} files at that time: write a series, -o NAME.pvd"),
    }
}

/// Contouring all parts of an input, at the same levels.
struct Job<'a> {
    input: &'a Input,
    options: ContourOptions,
    /// Whether the input's data travel along.
    has_data: bool,
    messages: &'a Messages,
    clock: Clock,
    warnings: Warnings,
    stats: Stats,
    /// Counts the cells of pieces, of which the contours are numbered as those of the whole.
    counter: Option<CellCounter>,
    /// Why the first of the parts without anything to contour has nothing.
    nothing: Option<anyhow::Error>,
}

impl Job<'_> {
    fn run(&mut self, output: &mut Output) -> Result<()> {
        self.input.warnings.iter().for_each(|text| self.warnings.add(None, text));
        if self.input.is_several() {
            self.look_ahead()?;
        }
        for (place, part) in self.input.parts.iter().enumerate() {
            self.contour_part(place, part, output)?;
        }
        self.clock.next(Step::Write);
        for array in output.write_joined()? {
            let text = format!("array '{array}' left out: it is not alike in all pieces");
            self.warnings.add(None, &text);
        }
        if self.stats.is_empty() {
            let all_empty = || anyhow!("nothing to contour: every piece is empty");
            return Err(self.nothing.take().unwrap_or_else(all_empty));
        }
        let of_gradients = self.stats.gradient_warning().filter(|_| self.input.is_in_pieces());
        for warning in of_gradients.into_iter().chain(self.stats.level_warning()) {
            self.warnings.add(None, &warning);
        }
        Ok(())
    }

    /// Finds out what only all parts together tell: the levels, if they are inside the range of
    /// all, and of pieces the size of the whole, for they have to be equally fine where they meet.
    fn look_ahead(&mut self) -> Result<()> {
        let needs_range = matches!(self.options.levels, Levels::Equal { range: None, .. });
        let is_in_pieces = self.input.is_in_pieces();
        if !needs_range && !is_in_pieces {
            return Ok(());
        }
        self.clock.next(Step::Range);
        let (mut range, mut extent) = (None, Extent::default());
        for (place, part) in self.input.parts.iter().enumerate() {
            self.stage(place, "looking for range and size");
            let arrays = if needs_range { Arrays::Needed(&self.options) } else { Arrays::OfCells };
            let grid = self.input.read(part, arrays)?.data;
            let found = match needs_range {
                true => preview(&grid, &self.options).map(|found| {
                    range = Some(joined(range, found.range));
                    found.extent
                }),
                false => Extent::of_grid(&grid, &self.options),
            };
            let found = match found {
                // cells without values count as well
                Err(error) if error.is_nothing_to_contour() => {
                    Extent::of_grid(&grid, &self.options)
                }
                found => found,
            };
            match found {
                Ok(found) => extent = extent.joined(found),
                Err(_) if grid.types.is_empty() => {}
                Err(error) => return Err(self.input.explained(part, &error)),
            }
        }
        if let Some(range) = range {
            self.options.levels = Levels::Explicit(self.options.levels.resolve(range)?);
        }
        self.options.size = is_in_pieces.then(|| extent.diagonal());
        Ok(())
    }

    fn contour_part(&mut self, place: usize, part: &Part, output: &mut Output) -> Result<()> {
        self.clock.next(Step::Read);
        self.stage(place, "reading");
        let arrays = if self.has_data { Arrays::All } else { Arrays::Needed(&self.options) };
        let loaded = self.input.read(part, arrays)?;
        let name = self.input.name(part);
        loaded.warnings.iter().for_each(|text| self.warnings.add(name.as_deref(), text));
        let entry = self.entry(part, &loaded.data);
        let numbers = self.counter.as_mut().map(|counter| counter.count(&loaded.data.types));
        let Some(mut contoured) = self.contour(place, part, loaded.data)? else { return Ok(()) };
        if let Some(numbers) = numbers {
            renumber_cells(&mut contoured.poly_data, |cell| numbers.in_whole(cell));
        }
        self.clock.next(Step::Write);
        self.stage(place, "writing");
        let report = &contoured.report;
        report.warnings.iter().for_each(|text| self.warnings.add(name.as_deref(), text));
        self.messages.detail(&described(&contoured, name.as_deref()));
        self.stats.add(&entry, &contoured);
        output.add(place, &entry, contoured)
    }

    /// The contours of a part; nothing if it holds nothing to contour, but others may.
    fn contour(
        &mut self,
        place: usize,
        part: &Part,
        grid: UnstructuredGrid,
    ) -> Result<Option<Contoured>> {
        let several = self.input.is_several();
        let is_empty = grid.types.is_empty();
        if several && is_empty && !self.input.is_series() {
            return Ok(None); // a process may have had no cells
        }
        let (clock, messages) = (&mut self.clock, self.messages);
        let prefix = prefix(place, self.input);
        let mut progress = |stage: Stage| {
            clock.next(Step::Filter(stage));
            messages.stage(&format!("{prefix}{}", name_of(stage)));
        };
        match contour_owned(grid, &self.options, &mut progress) {
            Ok(contoured) => Ok(Some(contoured)),
            // the pieces that own the cells contour them
            Err(FilterError::OnlyGhosts) if self.input.is_in_pieces() => Ok(None),
            Err(error) if several && (error.is_nothing_to_contour() || is_empty) => {
                self.warnings.add(self.input.name(part).as_deref(), &error.to_string());
                self.nothing.get_or_insert(self.input.explained(part, &error));
                Ok(None)
            }
            Err(error) => Err(self.input.explained(part, &error)),
        }
    }

    /// The part for a list: what is no step of a series has the time of its data.
    fn entry(&self, part: &Part, grid: &UnstructuredGrid) -> PvdEntry {
        let time_value = || grid.field_data.get("TimeValue")?.component(0)?.first().copied();
        let time = match self.input.is_series() {
            true => part.entry.time,
            false => part.entry.time.or_else(time_value),
        };
        PvdEntry { time, ..part.entry.clone() }
    }

    fn stage(&self, place: usize, text: &str) {
        self.messages.stage(&format!("{}{text}", prefix(place, self.input)));
    }
}

/// How far the job is, before what it is doing.
fn prefix(place: usize, input: &Input) -> String {
    match input.is_several() {
        true => format!("{} of {}: ", place + 1, input.parts.len()),
        false => String::new(),
    }
}

fn name_of(stage: Stage) -> &'static str {
    match stage {
        Stage::Field => "taking values and gradients",
        Stage::Interpolant => "building the cubics",
        Stage::Contour => "tracing contours",
        Stage::Data => "carrying data over",
    }
}

fn joined(all: Option<[f64; 2]>, [low, high]: [f64; 2]) -> [f64; 2] {
    all.map_or([low, high], |[least, greatest]| [least.min(low), greatest.max(high)])
}

/// Refuses to write over what is read, or two files under one name.
fn check_names(arguments: &ContourArguments, format: Format, input: &Input) -> Result<()> {
    let output = arguments.output();
    let mut written = vec![output.to_owned()];
    written.extend(arguments.output_options.stats.clone());
    if format.is_list() {
        written.extend((0..input.parts.len()).map(|place| listed_file(output, place)));
    }
    let mut taken: HashSet<PathBuf> = input.files()?.iter().map(|path| real_name(path)).collect();
    for path in written {
        if !taken.insert(real_name(&path)) {
            bail!("'{}' would be written over: give another name", path.display());
        }
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

/// What was done with a part, for those who want to know.
fn described(contoured: &Contoured, name: Option<&str>) -> String {
    let Contoured { lines, surface, report, .. } = contoured;
    let mut text = name.map_or(String::new(), |name| format!("{name}\n"));
    text += &format!(
        "array '{}', gradient {}, range {:?} to {:?}, {} levels",
        report.label,
        report.gradient,
        report.range[0],
        report.range[1],
        report.levels.len(),
    );
    if report.triangles > 0 {
        let (counts, closed) =
            (report.counts, lines.lines.iter().filter(|line| line.closed).count());
        text += &format!(
            "\n{} triangles; {} active, {} subdivided, {} unresolved\n\
             tolerance {:e}, spacing {:e}: {} lines ({closed} closed), {} points",
            report.triangles,
            counts.active,
            counts.divided,
            counts.unresolved,
            report.resolution.tolerance,
            report.resolution.spacing,
            lines.lines.len(),
            lines.points.len(),
        );
    }
    if let Some(fineness) = report.fineness {
        let counts = report.surface_counts;
        let fineness = match fineness {
            Fineness::Tolerance(tolerance) => format!("tolerance {tolerance:e}"),
            Fineness::PointsPerSide(points) => format!("{points} points a side"),
        };
        text += &format!(
            "\n{} tetrahedra; {} active, {} subdivided, {} unresolved\n\
             {fineness}: {} triangles, {} points",
            report.tetrahedra,
            counts.active,
            counts.divided,
            counts.unresolved,
            surface.triangles.len(),
            surface.points.len(),
        );
    }
    text
}
