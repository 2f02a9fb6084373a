//! A monitor of a grid's cells, as an array of the grid.

use std::borrow::Cow;

use super::cell_monitor::{CellMonitor, CellNumbers, Monitor};
use super::contour_filter::prepared;
use super::error::FilterError;
use super::interpolant::Interpolant;
use super::known_pde::KnownPde;
use super::options::ContourOptions;
use super::pde_warning::pde_warning;
use super::solution::Solution;
use crate::monitor::{SamplePoints, Selection, Summary};
use crate::vtk::{DataArray, UnstructuredGrid, Values};

/// Which monitor, and what is made of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MonitorOptions {
    /// Which monitor.
    pub monitor: Monitor,
    /// Where it looks in each cell.
    pub samples: SamplePoints,
    /// Which cells are marked; none are if not given.
    pub selection: Option<Selection>,
    /// The name of its cell array; [`Monitor::default_name`] if not given. That of the marks
    /// has `Marks` after it.
    pub name: Option<String>,
}

/// A monitor of an interpolant.
#[derive(Clone, Debug)]
pub struct Monitored {
    /// One number a cell, and if a selection was asked for one mark a cell (1: selected).
    pub arrays: Vec<DataArray>,
    /// The monitored array, such as `u` or `|velocity|`.
    pub label: String,
    /// The cells that were to be judged: the solids, or if there are none the two-dimensional
    /// cells, without those of other processes.
    pub cells: usize,
    /// What the monitor says of them as a whole; those not computed are not a number.
    pub summary: Summary,
    /// How many are selected; nothing if no selection was asked for.
    pub selected: Option<usize>,
    /// What people should know, a line each.
    pub warnings: Vec<String>,
}

/// A grid with a monitor.
#[derive(Clone, Debug)]
pub struct MonitoredGrid {
    /// The grid, with the arrays of `monitored` among its cells' data.
    pub grid: UnstructuredGrid,
    /// What was computed.
    pub monitored: Monitored,
}

/// Puts a monitor's numbers on the cells of a grid, and marks on those that are selected.
///
/// The solids are judged, or if there are none the two-dimensional cells. A cell that is not a
/// simplex has the sum of its parts' numbers where these are integrals (defect, area), and
/// where they are means (stepwise and interpolation error) their mean by size.
///
/// # Errors
/// If an array is missing or does not fit, or the monitor needs a PDE that is not given.
pub fn monitor(
    grid: &UnstructuredGrid,
    options: &MonitorOptions,
    solution: &ContourOptions,
) -> Result<MonitoredGrid, FilterError> {
    let grid = prepared(Cow::Borrowed(grid), solution)?;
    let interpolant = Interpolant::new(Solution::of_grid(&grid, solution)?, solution)?;
    let known = interpolant.solution.pde.as_deref();
    let monitored = Monitored::new(&interpolant, grid.types.len(), options, solution, known)?;
    let mut grid = grid.into_owned();
    monitored.arrays.iter().for_each(|array| grid.cell_data.push(array.clone()));
    Ok(MonitoredGrid { grid, monitored })
}

impl Monitored {
    /// A monitor of an interpolant that `solution` made, with one number for each of so many
    /// cells. `known`: the PDE that a defect is of.
    ///
    /// # Errors
    /// If the monitor needs a PDE and there is none, or has nothing to compare the interpolant
    /// with.
    pub fn new(
        interpolant: &Interpolant,
        cells: usize,
        options: &MonitorOptions,
        solution: &ContourOptions,
        known: Option<&KnownPde>,
    ) -> Result<Self, FilterError> {
        let monitor = CellMonitor::new(options.monitor, options.samples, known, solution);
        let CellNumbers { numbers, asked, failed } = monitor.of_cells(interpolant, cells)?;
        let selected = options.selection.map(|selection| selection.select(&numbers)).transpose()?;
        let summary = Summary { not_computed: failed, ..Summary::new(&numbers) };
        let name = options.name.as_deref().unwrap_or(options.monitor.default_name());
        let mut arrays = vec![DataArray::new(name, 1, numbers)];
        if let Some(selected) = &selected {
            let mut marks = vec![0_u8; cells];
            selected.iter().for_each(|&cell| marks[cell as usize] = 1);
            arrays.push(DataArray::new(format!("{name}Marks"), 1, Values::U8(marks)));
        }
        Ok(Self {
            arrays,
            label: interpolant.solution.label.clone(),
            cells: asked,
            summary,
            selected: selected.map(|cells| cells.len()),
            warnings: warnings(interpolant, asked, failed),
        })
    }
}

/// What people should know of a monitor, a line each.
fn warnings(interpolant: &Interpolant, asked: usize, failed: usize) -> Vec<String> {
    let Interpolant { solution, interpolation } = interpolant;
    let mut warnings = interpolation.warnings.clone();
    if solution.left_out.total() > 0 {
        warnings.push(format!("left out: {}", solution.left_out));
    }
    if let (Some(_), Some(lower)) = (&solution.tetrahedra, &solution.triangles) {
        let simplices = 0..lower.count() as u32;
        let mut cells: Vec<u32> = simplices.map(|simplex| lower.parent(simplex)).collect();
        cells.dedup();
        warnings.push(format!(
            "{} two-dimensional cells are not judged: the monitor is that of the solids",
            cells.len()
        ));
    }
    if failed > 0 {
        warnings.push(format!(
            "{failed} of {asked} cells could not be judged, and are NaN: they have no size, or \
             values, gradients or the PDE are not finite there"
        ));
    }
    let singular = interpolation.singular();
    if singular > 0 {
        warnings.push(format!("the PDE does not determine the cubic in {singular} cells"));
    }
    let fit = interpolation.triangles.as_ref().and_then(|found| found.pde_fit);
    warnings.extend(pde_warning(&solution.label, fit));
    warnings
}
