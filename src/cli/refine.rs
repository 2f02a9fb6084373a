//! `vtu2contour refine`: a finer mesh where that is asked for, with all data.

use std::path::PathBuf;

use anyhow::{Result, anyhow, bail};
use vtu2contour::filter::{RefineOptions, RefinedGrid, boundary_curves, refine, without_origins};
use vtu2contour::mesh::Vector;
use vtu2contour::vtk::{
    AtomicFile, Selection, UnstructuredGrid, WriteOptions, read_grid, write_vtu_to,
};

use super::arguments::RefineArguments;
use super::input::{Arrays, Input, Part};
use super::messages::Messages;
use super::running;
use super::solver::Solver;

/// Runs the job.
pub fn run(arguments: &RefineArguments) -> Result<()> {
    let extension = arguments.output.extension().and_then(|extension| extension.to_str());
    if !extension.is_some_and(|extension| extension.eq_ignore_ascii_case("vtu")) {
        bail!("cannot write '{}': a refined mesh is a .vtu", arguments.output.display());
    }
    if arguments.steps() > 1 && arguments.by.is_some() && arguments.solver.is_none() {
        bail!(
            "--by tells nothing of refined cells: leave --steps out, or give --solver, which \
             writes the array anew"
        );
    }
    running::run(&arguments.running, |messages| Job::new(arguments, messages).and_then(Job::run))
}

/// Steps of refinement, and of solving between them.
struct Job<'a> {
    arguments: &'a RefineArguments,
    options: RefineOptions,
    solver: Option<Solver<'a>>,
    messages: &'a Messages,
    input: Input,
    out: AtomicFile,
}

impl<'a> Job<'a> {
    fn new(arguments: &'a RefineArguments, messages: &'a Messages) -> Result<Self> {
        let options = arguments.write_options();
        let by = arguments.by.as_deref();
        let solver = arguments.solver.as_deref();
        let solver = solver.map(|command| Solver::new(command, by, options));
        messages.stage("reading");
        Ok(Self {
            arguments,
            options: arguments.options(curves(&arguments.boundaries)?),
            solver: solver.transpose()?,
            messages,
            input: Input::open(&arguments.input, arguments.scalars.time, false)?,
            out: AtomicFile::create(&arguments.output)?,
        })
    }

    fn run(mut self) -> Result<()> {
        let part = self.input.only_part()?;
        let mut grid = without_origins(self.input.read(part, Arrays::All)?.data);
        let mut warned = Vec::new();
        if let (Some(solver), true) = (&self.solver, self.lacks_array(&grid)) {
            self.messages.stage("solving");
            grid = solver.solve(&grid)?;
        }
        for step in 1..=self.arguments.steps() {
            if step > 1 && self.is_full(&grid) {
                break;
            }
            let next = self.step(part, step, &grid, &mut warned);
            let next = match next {
                Ok(next) => next,
                // nothing was refined yet: no output
                Err(error) if step == 1 => return Err(error),
                Err(error) => {
                    write(&mut self.out, &grid, self.arguments.write_options())?;
                    self.out.commit()?;
                    bail!(
                        "{error}; '{}' has the mesh of step {}",
                        self.arguments.output.display(),
                        step - 1
                    );
                }
            };
            let Some(next) = next else { break };
            grid = next;
        }
        write(&mut self.out, &grid, self.arguments.write_options())?;
        Ok(self.out.commit()?)
    }

    /// Whether the grid has as many points as it may have.
    fn is_full(&self, grid: &UnstructuredGrid) -> bool {
        self.arguments.max_points.is_some_and(|most| grid.points.tuples() >= most)
    }

    /// Whether the array that tells where to refine is not there yet.
    fn lacks_array(&self, grid: &UnstructuredGrid) -> bool {
        let by = self.arguments.by.as_deref();
        by.is_some_and(|name| grid.cell_data.get(name).is_none())
    }

    /// The grid of the next step, solved; nothing if there was nothing to refine, or no room.
    fn step(
        &self,
        part: &Part,
        step: u16,
        grid: &UnstructuredGrid,
        warned: &mut Vec<String>,
    ) -> Result<Option<UnstructuredGrid>> {
        self.messages.stage(&format!("refining, step {step}"));
        let refined = refine(grid, &self.options);
        let refined = refined.map_err(|error| self.input.explained(part, &error))?;
        self.tell(step, &refined, warned);
        if refined.added == 0 && step > 1 {
            return Ok(None);
        }
        let Some(solver) = &self.solver else { return Ok(Some(refined.grid)) };
        self.messages.stage(&format!("solving, step {step}"));
        Ok(Some(solver.solve(&refined.grid)?))
    }

    /// Tells what was done, and once what people should know.
    fn tell(&self, step: u16, refined: &RefinedGrid, warned: &mut Vec<String>) {
        let RefinedGrid { grid, marked, added, label, .. } = refined;
        self.messages.detail(&format!(
            "step {step}: {marked} cells marked, {added} points added: {} points, {} cells{}",
            grid.points.tuples(),
            grid.types.len(),
            label.as_ref().map_or(String::new(), |label| format!("; interpolated '{label}'"))
        ));
        for text in refined.messages() {
            if !warned.contains(&text) {
                self.messages.warning(&text);
                warned.push(text);
            }
        }
    }
}

/// The curves that files hold.
fn curves(files: &[PathBuf]) -> Result<Vec<Vec<Vector>>> {
    let mut curves = Vec::new();
    for file in files {
        let grid = read_grid(file, &Selection::All)?.data;
        let found = boundary_curves(&grid);
        curves.extend(found.map_err(|error| anyhow!("--boundary: '{}': {error}", file.display()))?);
    }
    Ok(curves)
}

fn write(out: &mut AtomicFile, grid: &UnstructuredGrid, options: WriteOptions) -> Result<()> {
    Ok(write_vtu_to(out, grid, options)?)
}
