//! `vtu2contour info`: what is in a file, and what would be contoured.

use std::io::{self, Write};

use anyhow::Result;
use vtu2contour::contour::CellRanges;
use vtu2contour::filter::{ContourOptions, FilterError, GradientOrigin, Interpolated, Solution};
use vtu2contour::simplices::{CellCounts, lagrange_grid};
use vtu2contour::vtk::{Attributes, DataArray, Description, Selection, UnstructuredGrid, VtuFile};

use super::arguments::InfoArguments;

/// Runs the job. A reader of the output who has seen enough is no error.
pub fn run(arguments: &InfoArguments) -> Result<()> {
    let file = VtuFile::open(&arguments.input)?;
    let description = file.description()?;
    let grid = file.read(&Selection::All)?.data;
    let mut text = Vec::new();
    writeln!(text, "{}", arguments.input.display())?;
    write_size(&mut text, &description, &grid)?;
    write_arrays(&mut text, "point arrays", &grid.point_data)?;
    write_arrays(&mut text, "cell arrays", &grid.cell_data)?;
    write_arrays(&mut text, "field arrays", &grid.field_data)?;
    for warning in &description.warnings {
        writeln!(text, "note: {warning}")?;
    }
    write_contour(&mut text, &grid, &arguments.scalars.options())?;
    match io::stdout().write_all(&text) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => Ok(result?),
    }
}

fn write_size(
    text: &mut Vec<u8>,
    description: &Description,
    grid: &UnstructuredGrid,
) -> io::Result<()> {
    let cells: CellCounts = grid.types.iter().copied().collect();
    let pieces = description.pieces.len();
    let version = &description.version;
    writeln!(
        text,
        "  {} points, {} cells ({cells}), {pieces} piece{}, format version {}",
        grid.points.tuples(),
        cells.total(),
        if pieces == 1 { "" } else { "s" },
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

fn write_contour(
    text: &mut Vec<u8>,
    grid: &UnstructuredGrid,
    options: &ContourOptions,
) -> io::Result<()> {
    writeln!(text, "contour")?;
    match plan(grid, options) {
        Ok(lines) => lines.iter().try_for_each(|line| writeln!(text, "  {line}")),
        Err(error) => writeln!(text, "  {error}"),
    }
}

/// What would be contoured, a line each.
fn plan(grid: &UnstructuredGrid, options: &ContourOptions) -> Result<Vec<String>, FilterError> {
    let grid = lagrange_grid(grid);
    let solution = Solution::new(&grid, options)?;
    let Interpolated { cubics, .. } = solution.interpolant(options.predictor);
    let ranges = CellRanges::new(cubics.as_ref());
    let [low, high] = solution.range(&ranges, cubics.as_ref())?;
    let levels = options.levels.resolve([low, high])?;
    let gradient = match &solution.gradients.origin {
        GradientOrigin::Array(name) => name.clone(),
        other => other.to_string(),
    };
    let mut lines = vec![
        format!("array     {}", solution.chosen.label()),
        format!("gradient  {gradient}"),
        format!("cells     {} triangles", solution.triangles.mesh.triangles().len()),
        format!("range     {low:?} to {high:?}"),
    ];
    if let (Some(first), Some(last)) = (levels.first(), levels.last()) {
        lines.push(format!("levels    {} by default, from {first:?} to {last:?}", levels.len()));
    }
    if solution.left_out.total() > 0 {
        lines.push(format!("left out  {}", solution.left_out));
    }
    let solids = solution.solids();
    if solids.total() > 0 {
        lines.push(format!("left out  {solids} (only two-dimensional cells are contoured)"));
    }
    if ranges.unusable() > 0 {
        lines.push(format!("left out  {} triangles with values not finite", ranges.unusable()));
    }
    lines.extend(solution.gradients.warning.iter().map(|warning| format!("note      {warning}")));
    Ok(lines)
}
