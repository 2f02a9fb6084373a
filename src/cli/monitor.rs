//! `vtu2contour monitor`: how much each cell needs to be refined, as a cell array.

use std::io::Write;

use anyhow::{Result, bail};
use serde::Serialize;
use vtu2contour::filter::{Monitored, monitor};
use vtu2contour::monitor::Summary;
use vtu2contour::vtk::{AtomicFile, ClosedFile, write_vtu_to};

use super::arguments::MonitorJobArguments;
use super::input::{Arrays, Input};
use super::messages::Messages;
use super::running;

/// Runs the job.
pub fn run(arguments: &MonitorJobArguments) -> Result<()> {
    let extension = arguments.output.extension().and_then(|extension| extension.to_str());
    if !extension.is_some_and(|extension| extension.eq_ignore_ascii_case("vtu")) {
        bail!("cannot write '{}': a grid with a monitor is a .vtu", arguments.output.display());
    }
    running::run(&arguments.running, |messages| job(arguments, messages))
}

fn job(arguments: &MonitorJobArguments, messages: &Messages) -> Result<()> {
    messages.stage("reading");
    let input = Input::open(&arguments.input, arguments.scalars.time, false)?;
    let part = input.only_part()?;
    let mut out = AtomicFile::create(&arguments.output)?;
    let stats = arguments.stats.as_ref().map(AtomicFile::create).transpose()?;
    let grid = input.read(part, Arrays::All)?.data;
    messages.stage("judging the cells");
    let made = monitor(&grid, &arguments.options(), &arguments.solution());
    let made = made.map_err(|error| input.explained(part, &error))?;
    tell(&made.monitored, messages);
    messages.stage("writing");
    write_vtu_to(&mut out, &made.grid, arguments.write_options())?;
    let stats = stats.map(|file| Stats::new(&made.monitored).write(file)).transpose()?;
    // both have their names only when both are whole
    let mut files = std::iter::once(out.close()?).chain(stats);
    Ok(files.try_for_each(ClosedFile::commit)?)
}

/// Tells what people should know, and the summary.
fn tell(monitored: &Monitored, messages: &Messages) {
    monitored.warnings.iter().for_each(|warning| messages.warning(warning));
    let Stats { array, name, cells, mean, largest, not_judged, .. } = Stats::new(monitored);
    messages.detail(&format!(
        "'{name}' of '{array}': {cells} cells, mean {mean:e}, largest {largest:e}, {not_judged} not \
         judged{}",
        monitored.selected.map_or(String::new(), |count| format!(", {count} selected"))
    ));
}

/// The summary, for `--stats`.
#[derive(Serialize)]
struct Stats<'a> {
    /// What the cubics are of.
    array: &'a str,
    /// The name of the cell array.
    name: &'a str,
    /// Cells that were to be judged.
    cells: usize,
    sum: f64,
    mean: f64,
    largest: f64,
    not_judged: usize,
    /// Null if no selection was asked for.
    selected: Option<usize>,
}

impl<'a> Stats<'a> {
    fn new(monitored: &'a Monitored) -> Self {
        let Summary { sum, average, maximum, not_computed } = monitored.summary;
        Self {
            array: &monitored.label,
            name: monitored.arrays.first().map_or("", |array| &array.name),
            cells: monitored.cells,
            sum,
            mean: average,
            largest: maximum,
            not_judged: not_computed,
            selected: monitored.selected,
        }
    }

    fn write(self, mut file: AtomicFile) -> Result<ClosedFile> {
        serde_json::to_writer_pretty(&mut file, &self)?;
        writeln!(file)?;
        Ok(file.close()?)
    }
}
