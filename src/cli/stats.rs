//! Counts and times of a job, for `--stats`.

use std::collections::BTreeSet;
use std::io::Write;
use std::ops::AddAssign;
use std::time::Instant;

use anyhow::Result;
use serde::Serialize;
use vtu2contour::contour::surface::Fineness;
use vtu2contour::filter::{Contoured, GradientOrigin, Stage, level_warning};
use vtu2contour::vtk::{AtomicFile, ClosedFile, PvdEntry};

/// Counts and times of a contouring, of all parts of the input together.
#[derive(Debug, Default, Serialize)]
pub struct Stats {
    array: String,
    levels: Vec<f64>,
    /// Places of the levels that have lines or surfaces.
    #[serde(skip)]
    drawn: BTreeSet<usize>,
    /// The arrays that the parts' gradients came from, on triangles and in tetrahedra; nothing
    /// for other gradients.
    #[serde(skip)]
    gradients: [BTreeSet<Option<String>>; 2],
    #[serde(flatten)]
    all: Counts,
    seconds: Seconds,
    /// Each part, where there are several: the steps of a series, or pieces.
    #[serde(skip_serializing_if = "is_single")]
    parts: Vec<PartStats>,
}

/// What was done with one part of the input.
#[derive(Debug, Serialize)]
struct PartStats {
    file: String,
    time: Option<f64>,
    #[serde(flatten)]
    counts: Counts,
}

/// What was done with a part, or with all.
#[derive(Clone, Debug, Default, Serialize)]
struct Counts {
    /// The gradient's array; null if it came from elsewhere, or if parts differ.
    gradient: Option<String>,
    /// `array`, `cells`, `recovered` or `unused`.
    gradient_origin: &'static str,
    /// Of the values at the points of cells that are contoured.
    range: [f64; 2],
    /// The greatest of all parts; null without a limit.
    tolerance: Option<f64>,
    /// The greatest of all parts; null without a limit.
    spacing: Option<f64>,
    /// The tolerance of surfaces, the greatest of all parts; null without surfaces or limit.
    surface_tolerance: Option<f64>,
    /// Points on each side of a surface's patch, the most of all parts; null by tolerance.
    points_per_side: Option<u32>,
    cells: Cells,
    output: Output,
}

/// What became of the cells.
#[derive(Clone, Debug, Default, Serialize)]
struct Cells {
    triangles: usize,
    tetrahedra: usize,
    /// Triangles and tetrahedra that hold a level, summed over the levels.
    active: usize,
    subdivided: usize,
    /// Pieces whose contour could not be settled.
    unresolved: usize,
    /// Triangles in which a level is touched, not crossed.
    touching: usize,
    /// Arcs and triangles of surfaces not as fine as asked.
    coarse: usize,
    /// Cells that are not contoured.
    skipped: usize,
    /// Triangles and tetrahedra with values that are not finite.
    not_finite: usize,
    ghosts: usize,
    singular_pde: usize,
}

#[derive(Clone, Debug, Default, Serialize)]
struct Output {
    points: usize,
    lines: usize,
    closed: usize,
    /// Of surfaces.
    triangles: usize,
}

/// Wall-clock seconds of each stage.
#[derive(Debug, Default, Serialize)]
pub struct Seconds {
    /// Looking for the range and the size of all parts; 0 where there was no need to.
    range: f64,
    read: f64,
    field: f64,
    interpolant: f64,
    contour: f64,
    data: f64,
    write: f64,
}

/// What takes time.
#[derive(Clone, Copy, Debug)]
pub enum Step {
    /// Looking for the range and the size of all parts.
    Range,
    /// Reading a file.
    Read,
    /// A stage of the filter.
    Filter(Stage),
    /// Writing the output.
    Write,
}

/// A stopwatch that changes from step to step.
pub struct Clock {
    seconds: Seconds,
    step: Step,
    since: Instant,
}

impl Clock {
    /// A clock that begins with reading.
    pub fn start() -> Self {
        Self { seconds: Seconds::default(), step: Step::Read, since: Instant::now() }
    }

    /// Ends the step that is running and begins another.
    pub fn next(&mut self, step: Step) {
        let elapsed = self.since.elapsed().as_secs_f64();
        let seconds = &mut self.seconds;
        *match self.step {
            Step::Range => &mut seconds.range,
            Step::Read => &mut seconds.read,
            Step::Filter(Stage::Field) => &mut seconds.field,
            Step::Filter(Stage::Interpolant) => &mut seconds.interpolant,
            Step::Filter(Stage::Contour) => &mut seconds.contour,
            Step::Filter(Stage::Data) => &mut seconds.data,
            Step::Write => &mut seconds.write,
        } += elapsed;
        (self.step, self.since) = (step, Instant::now());
    }

    /// Ends the last step.
    pub fn stop(mut self) -> Seconds {
        self.next(Step::Write);
        self.seconds
    }
}

impl Stats {
    /// Adds what was done with a part.
    pub fn add(&mut self, part: &PvdEntry, contoured: &Contoured) {
        let counts = Counts::new(contoured);
        if self.parts.is_empty() {
            self.array.clone_from(&contoured.report.label);
            self.levels.clone_from(&contoured.report.levels);
            self.all = counts.clone();
        } else {
            self.all += &counts;
        }
        for (all, origin) in self.gradients.iter_mut().zip(&contoured.report.gradients) {
            all.extend(origin.as_ref().map(|origin| match origin {
                GradientOrigin::Array(name) => Some(name.clone()),
                _ => None,
            }));
        }
        self.drawn.extend(contoured.lines.lines.iter().map(|line| line.level));
        let surfaces = contoured.surface.level_triangles.iter().enumerate();
        self.drawn.extend(surfaces.filter(|(_, range)| !range.is_empty()).map(|(level, _)| level));
        self.parts.push(PartStats {
            file: part.file.display().to_string(),
            time: part.time,
            counts,
        });
    }

    /// Whether nothing was contoured.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// What people should know about the levels.
    pub fn level_warning(&self) -> Option<String> {
        level_warning(&self.array, self.all.range, &self.levels, |level| {
            self.drawn.contains(&level)
        })
    }

    /// What people should know about the gradients, if the parts are pieces of a whole.
    pub fn gradient_warning(&self) -> Option<String> {
        let unlike = self.gradients.iter().find(|arrays| arrays.len() > 1)?;
        let names = unlike.iter().flatten().map(|name| format!("'{name}'"));
        Some(format!(
            "{} does not fit the values of all pieces, and is not taken as the gradient everywhere: \
             contours may not meet where pieces do; --gradient takes it everywhere",
            Vec::from_iter(names).join(" or ")
        ))
    }

    /// Writes all of it, and the times of the job.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(self, mut file: AtomicFile, seconds: Seconds) -> Result<ClosedFile> {
        serde_json::to_writer_pretty(&mut file, &Self { seconds, ..self })?;
        writeln!(file)?;
        Ok(file.close()?)
    }
}

fn is_single(parts: &[PartStats]) -> bool {
    parts.len() < 2
}

impl Counts {
    fn new(contoured: &Contoured) -> Self {
        let Contoured { poly_data, lines, report, .. } = contoured;
        let (gradient, gradient_origin) = match &report.gradient {
            GradientOrigin::Array(name) => (Some(name.clone()), "array"),
            GradientOrigin::Cells => (None, "cells"),
            GradientOrigin::Recovered => (None, "recovered"),
            GradientOrigin::Unused => (None, "unused"),
        };
        let limit = |value: f64| value.is_finite().then_some(value);
        let (surface_tolerance, points_per_side) = match report.fineness {
            None => (None, None),
            Some(Fineness::Tolerance(tolerance)) => (Some(tolerance), None),
            Some(Fineness::PointsPerSide(points)) => (None, Some(points)),
        };
        let (lines_counts, surface) = (report.counts, report.surface_counts);
        Self {
            gradient,
            gradient_origin,
            range: report.range,
            tolerance: limit(report.resolution.tolerance),
            spacing: limit(report.resolution.spacing),
            surface_tolerance,
            points_per_side,
            cells: Cells {
                triangles: report.triangles,
                tetrahedra: report.tetrahedra,
                active: lines_counts.active + surface.active,
                subdivided: lines_counts.divided + surface.divided,
                unresolved: lines_counts.unresolved + surface.unresolved,
                touching: lines_counts.touching,
                coarse: lines_counts.coarse + surface.coarse,
                skipped: report.left_out.total(),
                not_finite: lines_counts.unusable + surface.unusable,
                ghosts: report.ghosts,
                singular_pde: report.singular,
            },
            output: Output {
                points: poly_data.points.tuples(),
                lines: poly_data.lines.len(),
                closed: lines.lines.iter().filter(|line| line.closed).count(),
                triangles: poly_data.polys.len(),
            },
        }
    }
}

impl AddAssign<&Counts> for Counts {
    fn add_assign(&mut self, part: &Counts) {
        let greatest = |a: Option<f64>, b: Option<f64>| Some(a?.max(b?));
        if self.gradient != part.gradient {
            self.gradient = None;
        }
        self.range[0] = self.range[0].min(part.range[0]);
        self.range[1] = self.range[1].max(part.range[1]);
        self.tolerance = greatest(self.tolerance, part.tolerance);
        self.spacing = greatest(self.spacing, part.spacing);
        self.surface_tolerance = greatest(self.surface_tolerance, part.surface_tolerance);
        self.points_per_side = self.points_per_side.max(part.points_per_side);
        let (cells, more) = (&mut self.cells, &part.cells);
        cells.triangles += more.triangles;
        cells.tetrahedra += more.tetrahedra;
        cells.active += more.active;
        cells.subdivided += more.subdivided;
        cells.unresolved += more.unresolved;
        cells.touching += more.touching;
        cells.coarse += more.coarse;
        cells.skipped += more.skipped;
        cells.not_finite += more.not_finite;
        cells.ghosts += more.ghosts;
        cells.singular_pde += more.singular_pde;
        self.output.points += part.output.points;
        self.output.lines += part.output.lines;
        self.output.closed += part.output.closed;
        self.output.triangles += part.output.triangles;
    }
}
