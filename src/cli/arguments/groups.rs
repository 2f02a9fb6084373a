//! Options by what they are about.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use vtu2contour::contour::Levels;
use vtu2contour::contour::surface::MOST_POINTS;
use vtu2contour::filter::{Component, ContourOptions, GradientSource, Monitor};
use vtu2contour::monitor::{SamplePoints, Selection};
use vtu2contour::vtk::{Floats, WriteOptions};

use super::names::{
    EncodingName, Interpolant, MethodName, MonitorName, PredictorName, SecondInterpolantName,
};
use super::values::{
    Time, component, level, not_negative, parameter, positive, range, samples, selection, time,
};

/// Which array.
#[derive(Debug, Args)]
#[command(next_help_heading = "What to contour")]
pub struct ScalarArguments {
    /// Of a series (.pvd), only the step at this time
    ///
    /// Files of the series without a time belong to all steps.
    #[arg(long, value_name = "T|first|last", value_parser = time, allow_hyphen_values = true)]
    pub time: Option<Time>,

    /// Point array to contour [default: the active scalars, else the only scalar array]
    #[arg(short, long, value_name = "NAME")]
    pub array: Option<String>,

    /// Component of a vector array, from 0, or its length
    #[arg(long, value_name = "N|mag", value_parser = component)]
    pub component: Option<Component>,

    /// Point array with the gradient, or 'recover' to recover it from the values
    /// [default: an array with a usual name, such as 'gradient' or 'grad_u', else by the
    /// shape functions of quadratic cells, else recovered]
    #[arg(short, long, value_name = "NAME")]
    pub gradient: Option<String>,

    /// Make points one that are no further apart than this, in the mesh's unit; 0 (or no
    /// number) for points at exactly the same place, as discontinuous elements have them
    #[arg(
        long, value_name = "TOL", num_args = 0..=1, default_missing_value = "0",
        value_parser = not_negative
    )]
    pub merge_points: Option<f64>,
}

/// Which levels.
#[derive(Debug, Args)]
#[command(next_help_heading = "Levels")]
pub struct LevelArguments {
    /// Levels; may be repeated
    #[arg(
        short, long = "value", value_name = "V,...", value_delimiter = ',', value_parser = level,
        allow_hyphen_values = true
    )]
    pub values: Vec<f64>,

    /// So many levels, equally spaced strictly inside the range
    ///
    /// Steps of a series, and pieces that are taken one at a time, have the same levels, inside the
    /// range of all of them. For that the cubics of each are made twice: --range or --value saves
    /// it.
    #[arg(
        short = 'n', long, value_name = "N", default_value_t = 10, conflicts_with = "values",
        value_parser = clap::value_parser!(u16).range(1..)
    )]
    pub levels: u16,

    /// The range to divide [default: that of the solution]
    #[arg(
        long, value_name = "LO,HI", value_parser = range, conflicts_with = "values",
        allow_hyphen_values = true
    )]
    pub range: Option<[f64; 2]>,
}

/// Which interpolant.
#[derive(Debug, Args)]
#[command(next_help_heading = "Interpolant")]
pub struct InterpolantArguments {
    /// The PDE that the solution satisfies, such as 'uxx + uyy = -k*u'
    ///
    /// Left, a sum of second derivatives (uxx uyy uzz uxy uxz uyz) with coefficients of
    /// x, y, z; right, any expression of x y z u ux uy uz, parameters, other point arrays,
    /// the usual functions, pi and e. Terms may stand on either side.
    #[arg(long, value_name = "EQUATION", allow_hyphen_values = true)]
    pub pde: Option<String>,

    /// A parameter of the PDE; may be repeated
    #[arg(long = "param", value_name = "NAME=V", value_parser = parameter, requires = "pde")]
    pub parameters: Vec<(String, f64)>,

    /// Which interpolant
    #[arg(long, value_name = "I", value_enum, default_value_t = Interpolant::Pci)]
    pub interpolant: Interpolant,

    /// Where the PDE's right-hand side takes the solution from
    #[arg(long, value_name = "P", value_enum, default_value_t = PredictorName::Quadratic)]
    pub predictor: PredictorName,
}

/// Which monitor, and which cells it selects.
#[derive(Debug, Args)]
#[command(next_help_heading = "Where")]
pub struct MonitorArguments {
    /// By this monitor, a number for each cell that says how much it needs to be refined
    #[arg(short, long, value_name = "M", value_enum)]
    pub monitor: Option<MonitorName>,

    /// What --monitor interpolation compares the cubics with [default: with --pde fqi, in solids
    /// p3; without it quadratic-precision]
    #[arg(long, value_name = "I", value_enum)]
    second: Option<SecondInterpolantName>,

    /// Where monitors look in each cell: 'fixed', points that are mirrored with the cell;
    /// random:SEED or random:SEED:N, that many random points (9 if not told), the same for the
    /// same seed; N, so many of seed 0
    #[arg(
        long, value_name = "HOW", default_value = "fixed", value_parser = samples
    )]
    pub samples: SamplePoints,

    /// Which cells are selected: average:K, those above K times the average (the thesis has 2);
    /// fraction:F, this part of the cells; bulk:F, the fewest cells with this part of the sum;
    /// tolerance:V, those above V
    ///
    /// Cells whose numbers differ by rounding alone are selected together, so that symmetric
    /// meshes stay symmetric.
    #[arg(long, value_name = "HOW:NUMBER", value_parser = selection)]
    pub select: Option<Selection>,
}

/// How lines are drawn.
#[derive(Debug, Args)]
#[command(next_help_heading = "Lines")]
pub struct LineArguments {
    /// How curves between the edges of cells are found
    #[arg(long, value_name = "M", value_enum, default_value_t = MethodName::Aodea)]
    pub method: MethodName,

    /// Greatest distance of a segment or a triangle from the contour, in the mesh's unit
    /// [default: 1e-5 of the bounding box's diagonal; for surfaces 1e-3]
    ///
    /// Steps of a series have each the default of their own box.
    #[arg(long, value_name = "T", value_parser = positive)]
    pub tolerance: Option<f64>,

    /// Greatest distance between neighbouring points, in the mesh's unit
    #[arg(long, value_name = "D", value_parser = positive)]
    pub spacing: Option<f64>,
}

/// How surfaces are drawn.
#[derive(Debug, Args)]
#[command(next_help_heading = "Surfaces")]
pub struct SurfaceArguments {
    /// Points on each side of a patch of the surface, instead of a tolerance: 2 for no more
    /// points than crossings of edges, 3 for four times as many triangles, and so on
    #[arg(
        long, value_name = "N", conflicts_with_all = ["tolerance", "triangles"],
        value_parser = clap::value_parser!(u32).range(2..=i64::from(MOST_POINTS))
    )]
    pub nside: Option<u32>,

    /// The finest --nside with no more triangles than this, all levels together
    #[arg(long, value_name = "N", conflicts_with = "tolerance")]
    pub triangles: Option<usize>,
}

/// What is written.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct OutputArguments {
    /// Two-point segments as VTK's filter writes, each with its own cell's data
    #[arg(long)]
    pub segments: bool,

    /// Write the gradient at each point, as 'Gradients'
    #[arg(long)]
    pub gradients: bool,

    /// Write the unit vector against the gradient, as 'Normals'
    #[arg(long)]
    pub normals: bool,

    /// Floating-point numbers of single precision [default: as in the input]
    #[arg(long, conflicts_with = "double")]
    pub single: bool,

    /// Floating-point numbers of double precision
    #[arg(long)]
    pub double: bool,

    /// Encoding of the arrays in .vtp and .vtu
    #[arg(long, value_name = "E", value_enum, default_value_t = EncodingName::Raw)]
    pub encoding: EncodingName,

    /// Draw the mesh behind the lines of an .svg
    #[arg(long)]
    pub mesh: bool,

    /// Write counts and times as JSON
    #[arg(long, value_name = "FILE")]
    pub stats: Option<PathBuf>,
}

/// How the job runs.
#[derive(Debug, Args)]
#[command(next_help_heading = "Running")]
pub struct RunArguments {
    /// Threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,

    /// No warnings and no progress
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,

    /// Tell what was chosen and counted
    #[arg(long)]
    pub verbose: bool,

    /// No progress on the terminal
    #[arg(long)]
    pub no_progress: bool,
}

impl ScalarArguments {
    /// Fills in which array is contoured.
    pub fn options(&self) -> ContourOptions {
        let gradient = match self.gradient.as_deref() {
            None => GradientSource::Automatic,
            Some("recover") => GradientSource::Recovered,
            Some(name) => GradientSource::Array(name.to_owned()),
        };
        ContourOptions {
            array: self.array.clone(),
            component: self.component,
            gradient,
            merge_points: self.merge_points,
            ..ContourOptions::default()
        }
    }
}

impl InterpolantArguments {
    /// Fills in which interpolant.
    pub fn options(&self, options: ContourOptions) -> ContourOptions {
        ContourOptions {
            interpolant: self.interpolant.into(),
            pde: self.pde.clone(),
            parameters: self.parameters.clone(),
            predictor: self.predictor.into(),
            ..options
        }
    }
}

impl MonitorArguments {
    /// The monitor asked for; the defect if there is none.
    pub fn monitor(&self) -> Monitor {
        match self.monitor {
            None | Some(MonitorName::Defect) => Monitor::Defect,
            Some(MonitorName::Area) => Monitor::SurfaceArea,
            Some(MonitorName::Stepwise) => Monitor::StepwiseError,
            Some(MonitorName::Interpolation) => {
                Monitor::InterpolationError(self.second.map(Into::into))
            }
        }
    }
}

impl RunArguments {
    /// Starts as many threads as are asked for.
    pub fn start_threads(&self) -> Result<()> {
        let Some(threads) = self.threads else { return Ok(()) };
        rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(threads))
            .build_global()
            .context("cannot start the threads")
    }
}

impl LevelArguments {
    /// The levels asked for.
    pub fn levels(&self) -> Levels {
        if self.values.is_empty() {
            Levels::Equal { count: usize::from(self.levels), range: self.range }
        } else {
            Levels::Explicit(self.values.clone())
        }
    }
}

impl OutputArguments {
    /// Whether floats are of single precision; nothing to have them as in the input.
    pub fn single(&self) -> Option<bool> {
        match (self.single, self.double) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    /// How files are written.
    pub fn write_options(&self) -> WriteOptions {
        let floats = match self.single() {
            Some(true) => Floats::Single,
            Some(false) => Floats::Double,
            None => Floats::AsGiven,
        };
        WriteOptions { encoding: self.encoding.into(), floats }
    }
}
