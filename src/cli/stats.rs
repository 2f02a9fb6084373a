//! Counts and times of a job, for `--stats`.

use std::time::Instant;

use serde::Serialize;
use vtu2contour::filter::{Contoured, GradientOrigin, Stage};

/// Counts and times of a contouring.
#[derive(Debug, Serialize)]
pub struct Stats {
    array: String,
    /// The gradient's array; null if it came from elsewhere.
    gradient: Option<String>,
    /// `array`, `cells`, `recovered` or `unused`.
    gradient_origin: &'static str,
    range: [f64; 2],
    levels: Vec<f64>,
    tolerance: Option<f64>,
    spacing: Option<f64>,
    cells: Cells,
    output: Output,
    seconds: Seconds,
}

/// What became of the cells.
#[derive(Debug, Serialize)]
struct Cells {
    triangles: usize,
    /// Triangles that hold a level, summed over the levels.
    active: usize,
    subdivided: usize,
    /// Pieces whose contour could not be settled.
    unresolved: usize,
    /// Triangles in which a level is touched, not crossed.
    touching: usize,
    /// Arcs not as fine as asked.
    coarse: usize,
    /// Cells that are not contoured.
    skipped: usize,
    /// Triangles with values that are not finite.
    not_finite: usize,
    ghosts: usize,
    singular_pde: usize,
}

#[derive(Debug, Serialize)]
struct Output {
    points: usize,
    lines: usize,
    closed: usize,
}

/// Wall-clock seconds of each stage.
#[derive(Debug, Default, Serialize)]
pub struct Seconds {
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
    /// Reading the file.
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
    /// The times of the job.
    pub fn with_times(self, seconds: Seconds) -> Self {
        Self { seconds, ..self }
    }

    /// The counts of a contouring.
    pub fn new(contoured: &Contoured) -> Self {
        let Contoured { poly_data, lines, report, .. } = contoured;
        let (gradient, gradient_origin) = match &report.gradient {
            GradientOrigin::Array(name) => (Some(name.clone()), "array"),
            GradientOrigin::Cells => (None, "cells"),
            GradientOrigin::Recovered => (None, "recovered"),
            GradientOrigin::Unused => (None, "unused"),
        };
        let limit = |value: f64| value.is_finite().then_some(value);
        Self {
            array: report.label.clone(),
            gradient,
            gradient_origin,
            range: report.range,
            levels: lines.levels.clone(),
            tolerance: limit(report.resolution.tolerance),
            spacing: limit(report.resolution.spacing),
            cells: Cells {
                triangles: report.triangles,
                active: report.counts.active,
                subdivided: report.counts.divided,
                unresolved: report.counts.unresolved,
                touching: report.counts.touching,
                coarse: report.counts.coarse,
                skipped: report.left_out.total() + report.solids.total(),
                not_finite: report.counts.unusable,
                ghosts: report.ghosts,
                singular_pde: report.singular,
            },
            output: Output {
                points: poly_data.points.tuples(),
                lines: poly_data.lines.len(),
                closed: lines.lines.iter().filter(|line| line.closed).count(),
            },
            seconds: Seconds::default(),
        }
    }
}
