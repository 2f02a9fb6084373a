//! `vtu2contour info`: what is in a file, and what would be contoured.

use std::io::{self, Write};

use anyhow::Result;
use vtu2contour::filter::ContourOptions;
use vtu2contour::simplices::CellCounts;
use vtu2contour::vtk::{Attributes, DataArray, Description, UnstructuredGrid};

use super::arguments::InfoArguments;
use super::input::{Arrays, Input, Part};
use super::plan::Plan;

/// Runs the job. A reader of the output who has seen enough is no error.
pub fn run(arguments: &InfoArguments) -> Result<()> {
    let input = Input::open(&arguments.input, arguments.scalars.time, false)?;
    let mut text = Vec::new();
    writeln!(text, "{}", arguments.input.display())?;
    if input.is_series() {
        write_series(&mut text, &input)?;
    }
    if let Some(first) = input.parts.first() {
        write_grid(&mut text, &input, first)?;
    }
    write_contour(&mut text, &input, &arguments.scalars.options())?;
    match io::stdout().write_all(&text) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => Ok(result?),
    }
}

/// The files of a series and their times.
fn write_series(text: &mut Vec<u8>, input: &Input) -> io::Result<()> {
    const ENDS: usize = 5;
    let files = &input.parts;
    writeln!(text, "  series, {}", counted(files.len(), "file"))?;
    for (place, Part { entry, .. }) in files.iter().enumerate() {
        if place == ENDS && files.len() > 2 * ENDS {
            writeln!(text, "  ... {} more", files.len() - 2 * ENDS)?;
        }
        if place < ENDS || place + ENDS >= files.len() {
            let time = entry.time.map_or("no time".to_owned(), |time| format!("time {time}"));
            writeln!(text, "  {time}  {}", entry.file.display())?;
        }
    }
    match &files[..] {
        [first, _, ..] => writeln!(text, "first file, {}", first.entry.file.display()),
        _ => Ok(()),
    }
}

/// What is in one file.
fn write_grid(text: &mut Vec<u8>, input: &Input, part: &Part) -> Result<()> {
    let description = input.describe(part)?;
    let grid = input.read(part, Arrays::All)?.data;
    write_size(text, &description, &grid)?;
    write_arrays(text, "point arrays", &grid.point_data)?;
    write_arrays(text, "cell arrays", &grid.cell_data)?;
    write_arrays(text, "field arrays", &grid.field_data)?;
    for warning in &description.warnings {
        writeln!(text, "note: {warning}")?;
    }
    Ok(())
}

fn write_size(
    text: &mut Vec<u8>,
    description: &Description,
    grid: &UnstructuredGrid,
) -> io::Result<()> {
    let cells: CellCounts = grid.types.iter().copied().collect();
    let pieces = counted(description.pieces.len(), "piece");
    let version = &description.version;
    writeln!(
        text,
        "  {} points, {} cells ({cells}), {pieces}, format version {}",
        grid.points.tuples(),
        cells.total(),
        if version.is_empty() { "not given" } else { version },
    )?;
    let axes = ["x", "y", "z"].iter().enumerate().filter_map(|(n, axis)| {
        let [low, high] = range(&grid.points.component(n)?)?;
        Some(format!("{axis} {}", span(low, high)))
    });
    let axes: Vec<String> = axes.collect();
    writeln!(text, "  {} ({})", axes.join(", "), grid.points.array_type())
}

fn write_arrays(text: &mut Vec<u8>, title: &str, arrays: &Attributes) -> io::Result<()> {
    if arrays.is_empty() {
        return Ok(());
    }
    writeln!(text, "{title}")?;
    let longest = arrays.iter().map(|array| array.name.chars().count()).max().unwrap_or(0);
    for array in arrays {
        let roles: Vec<String> = arrays
            .active_names()
            .iter()
            .filter(|(_, name)| *name == array.name)
            .map(|(kind, _)| format!("  active {}", kind.name()))
            .collect();
        writeln!(
            text,
            "  {:longest$}  {} x {}  {}{}",
            array.name,
            array.array_type(),
            array.components,
            values(array),
            roles.concat(),
        )?;
    }
    Ok(())
}

/// The range of an array's values, or of its tuples' lengths.
fn values(array: &DataArray) -> String {
    let (numbers, what) = if array.components == 1 {
        (array.component(0), "")
    } else {
        (array.magnitude(), "length ")
    };
    match numbers.as_deref().map(range) {
        Some(Some([low, high])) => format!("{what}{}", span(low, high)),
        Some(None) => "no finite value".to_owned(),
        None => "text".to_owned(),
    }
}

fn range(values: &[f64]) -> Option<[f64; 2]> {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    finite.fold(None, |range, value| {
        let [low, high] = range.unwrap_or([value; 2]);
        Some([low.min(value), high.max(value)])
    })
}

fn span(low: f64, high: f64) -> String {
    if low == high { format!("{low:?}") } else { format!("{low:?} to {high:?}") }
}

/// What would be contoured.
fn write_contour(text: &mut Vec<u8>, input: &Input, options: &ContourOptions) -> Result<()> {
    writeln!(text, "contour")?;
    let plan = Plan::new(input, options)?;
    plan.lines(options, input.parts.len())
        .iter()
        .try_for_each(|line| writeln!(text, "  {line}"))?;
    Ok(())
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
