//! A program that solves on a mesh.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, anyhow, bail};
use vtu2contour::vtk::{Selection, UnstructuredGrid, WriteOptions, read_grid, write_vtu};

/// A program that solves on a mesh.
pub struct Solver<'a> {
    command: &'a str,
    /// The cell array that it is to write.
    by: Option<&'a str>,
    options: WriteOptions,
}

/// Points of the solver's mesh may be this far from where they were, as a part of the greatest
/// coordinate: it may write them in single precision.
const SAME: f64 = 1e-6;

impl<'a> Solver<'a> {
    /// The program that a shell runs for this command; `{input}` and `{output}` stand for the
    /// files. `by`: the cell array that refinement goes by; it must be written anew each time.
    pub fn new(command: &'a str, by: Option<&'a str>, options: WriteOptions) -> Result<Self> {
        if let Some(missing) = ["{input}", "{output}"].iter().find(|name| !command.contains(**name))
        {
            bail!("--solver: the command must name {missing}, as in 'solve {{input}} {{output}}'");
        }
        Ok(Self { command, by, options })
    }

    /// The grid with the arrays that the program gives it.
    pub fn solve(&self, grid: &UnstructuredGrid) -> Result<UnstructuredGrid> {
        let folder = tempfile::tempdir().context("--solver: no folder for the files")?;
        let [input, output] = ["input.vtu", "output.vtu"].map(|name| folder.path().join(name));
        write_vtu(&input, grid, self.options)?;
        let quoted = |path: &Path| format!("'{}'", path.display());
        let command = self.command.replace("{input}", &quoted(&input));
        let command = command.replace("{output}", &quoted(&output));
        let status = Command::new("sh").arg("-c").arg(&command).status();
        let status = status.map_err(|error| anyhow!("--solver: no shell to run it: {error}"))?;
        if !status.success() {
            bail!("--solver: '{}' failed ({status})", self.command);
        }
        if !output.is_file() {
            bail!("--solver: '{}' did not write {{output}}", self.command);
        }
        let solved = read_grid(&output, &Selection::All);
        let solved = solved.map_err(|error| anyhow!("--solver: what it wrote: {error}"))?.data;
        refuse_other_mesh(grid, &solved)?;
        if let Some(name) = self.by.filter(|name| solved.cell_data.get(name).is_none()) {
            bail!("--solver: it did not write the cell array '{name}', and --by needs it");
        }
        let mut with = grid.clone();
        for (mine, its) in [
            (&mut with.point_data, &solved.point_data),
            (&mut with.cell_data, &solved.cell_data),
            (&mut with.field_data, &solved.field_data),
        ] {
            its.iter().for_each(|array| mine.push(array.clone()));
            for (kind, name) in its.active_names() {
                mine.set_active(*kind, name);
            }
        }
        Ok(with)
    }
}

/// The program must have solved on the mesh it was given: data are carried by the numbers of
/// points and cells.
fn refuse_other_mesh(given: &UnstructuredGrid, solved: &UnstructuredGrid) -> Result<()> {
    let cure = "it must keep all points and cells, in their order";
    let counts = |grid: &UnstructuredGrid| (grid.points.tuples(), grid.types.len());
    let ((points, cells), (its_points, its_cells)) = (counts(given), counts(solved));
    if (points, cells) != (its_points, its_cells) {
        bail!(
            "--solver: it was given {points} points and {cells} cells, and wrote {its_points} and \
             {its_cells}: {cure}"
        );
    }
    let same = given.types == solved.types && given.cells == solved.cells;
    let (mine, its) = (given.points.to_f64(), solved.points.to_f64());
    let (mine, its) = (mine.unwrap_or_default(), its.unwrap_or_default());
    let size = mine.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let near =
        mine.len() == its.len() && mine.iter().zip(&its).all(|(a, b)| (a - b).abs() <= SAME * size);
    if !same || !near {
        let what = if same { "points lie elsewhere" } else { "cells are others" };
        bail!("--solver: it wrote another mesh, its {what}: {cure}");
    }
    Ok(())
}
