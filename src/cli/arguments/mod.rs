//! What can be said on the command line.

use std::path::{Path, PathBuf};

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use vtu2contour::filter::{ContourOptions, MarkedBy, MonitorOptions, RefineOptions, SampleOptions};
use vtu2contour::mesh::Vector;
use vtu2contour::vtk::WriteOptions;

mod groups;
mod names;
mod values;

pub use groups::{
    InterpolantArguments, LevelArguments, LineArguments, MonitorArguments, OutputArguments,
    RunArguments, ScalarArguments, SurfaceArguments,
};
pub use values::Time;

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

const EXAMPLES: &str = "\
\x1b[1;32mExamples:\x1b[0m
  Ten contour lines of the only scalar array, as a picture:
    vtu2contour solution.vtu -o lines.svg

  Three levels of array u for ParaView:
    vtu2contour solution.vtu -o lines.vtp -a u -v 0.1,0.2,0.3

  With the PDE that the solution satisfies, which makes the cubics more exact:
    vtu2contour solution.vtu -o lines.vtp --pde 'uxx + uyy = -k*u' --param k=20

  Every step of a series at the same levels; lines.pvd lists lines/lines_0.vtp ...:
    vtu2contour run.pvd -o lines.pvd -a u

  One step of it, as a picture:
    vtu2contour run.pvd -o last.svg -a u --time last

  What is in a file, and what would be contoured:
    vtu2contour info solution.vtu

  The cubics on a mesh as fine as they need, for ParaView:
    vtu2contour interpolate solution.vtu -o fine.vtu --tolerance 1e-3

  How far each cell is from satisfying the PDE, as a cell array for ParaView:
    vtu2contour monitor solution.vtu -o defect.vtu -m defect --pde 'uxx + uyy = -6'

  A mesh of 2500 points, finer where that is largest:
    vtu2contour refine solution.vtu -o finer.vtu -m defect --pde 'uxx + uyy = -6' \
      --max-points 2500

Without a gradient array (say where it is with -g) gradients are recovered from
the values. 'vtu2contour --help' explains every option.";

/// Contour lines of a finite-element solution, as accurate as its data.
///
/// Reads a grid or a surface of any of VTK's files with values and gradients at its points,
/// makes one cubic polynomial of them in each triangle (the Differential Equation
/// Interpolant), and draws the contour lines of these cubics: smooth lines from a
/// coarse mesh, none missed, each point exactly on its level.
#[derive(Debug, Parser)]
#[command(
    version,
    styles = STYLES,
    after_help = EXAMPLES,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    max_term_width = 100,
)]
pub struct Cli {
    /// Another job than contouring.
    #[command(subcommand)]
    pub command: Option<Command>,

    /// Contouring, the job without a name.
    #[command(flatten)]
    pub contour: ContourArguments,
}

/// The jobs.
#[derive(Debug, Subcommand)]
#[allow(clippy::large_enum_variant)] // there is one of it in a run
pub enum Command {
    /// Draw contour lines (the same as leaving the word 'contour' out)
    Contour(ContourArguments),
    /// Tell what is in a file, and what would be contoured
    Info(InfoArguments),
    /// Evaluate the cubics at given points, on a finer mesh or on a regular grid
    Interpolate(InterpolateArguments),
    /// Say where the mesh should be finer: a number for each cell, as a cell array
    Monitor(MonitorJobArguments),
    /// Refine the mesh where that is asked for, with all its data, in one step or several
    Refine(RefineArguments),
    /// Print completions for a shell, to be sourced by it
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// Arguments of `info`.
#[derive(Debug, Args)]
pub struct InfoArguments {
    /// The grid, surface or series (.vtu .pvtu .vtp .pvtp .vtk .pvd)
    pub input: PathBuf,

    #[command(flatten)]
    pub scalars: ScalarArguments,
}

/// Arguments of `interpolate`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("where").required(true))]
pub struct InterpolateArguments {
    /// The grid or surface (.vtu .pvtu .vtp .pvtp .vtk), or a step of a series (.pvd)
    pub input: PathBuf,

    /// Values by the array's name, gradients as 'Gradients', and the input's other point
    /// data, interpolated linearly
    ///
    /// With --at: .csv, .vtp (the points alone) or .vtu (with the cells of FILE). With --grid:
    /// .vti. A refined mesh: .vtu, whose cells have the data of the input's.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    /// At the points of a file: .csv (columns x, y and z, or the first two or three), or any
    /// of VTK's grids and surfaces. Points outside the mesh are NaN, and counted
    #[arg(long, value_name = "FILE", group = "where", help_heading = "Where")]
    pub at: Option<PathBuf>,

    /// On the mesh with each edge in N equal parts: N² triangles for one, N³ tetrahedra
    #[arg(
        long, value_name = "N", group = "where", help_heading = "Where",
        value_parser = clap::value_parser!(u32).range(1..=1024)
    )]
    pub subdivide: Option<u32>,

    /// On the mesh refined until the cubics are nowhere further than T from linear, in the
    /// unit of the values: only where that is needed, and without hanging points
    #[arg(
        long, value_name = "T", group = "where", help_heading = "Where",
        value_parser = values::positive
    )]
    pub tolerance: Option<f64>,

    /// On so many regular points along x, y and z in the box around the mesh
    #[arg(
        long, value_name = "NX,NY[,NZ]", group = "where", help_heading = "Where",
        value_parser = values::counts
    )]
    pub grid: Option<[usize; 3]>,

    #[command(flatten)]
    pub scalars: ScalarArguments,

    #[command(flatten)]
    pub interpolant: InterpolantArguments,

    /// Instead of --interpolant a member of the thesis' family, which satisfies --pde at several
    /// points of each cell, and jumps from cell to cell: to be compared, not to be contoured
    #[arg(
        long, value_name = "MEMBER", value_enum, help_heading = "Interpolant", requires = "pde",
        conflicts_with_all = ["interpolant", "tolerance"]
    )]
    family: Option<names::FamilyMemberName>,

    /// Encoding of the arrays in VTK's files
    #[arg(
        long, value_name = "E", value_enum, default_value_t = names::EncodingName::Raw,
        help_heading = "Output"
    )]
    encoding: names::EncodingName,

    #[command(flatten)]
    pub running: RunArguments,
}

impl InterpolateArguments {
    /// What the arguments say of the interpolant.
    pub fn sample_options(&self) -> SampleOptions {
        let solution = self.interpolant.options(self.scalars.options());
        SampleOptions { solution, family: self.family.map(Into::into) }
    }

    /// How files are written.
    pub fn write_options(&self) -> WriteOptions {
        WriteOptions { encoding: self.encoding.into(), ..WriteOptions::default() }
    }
}

/// Arguments of `monitor`.
#[derive(Debug, Args)]
#[command(
    group = clap::ArgGroup::new("which").required(true).arg("monitor"),
    after_help = MONITOR_EXAMPLES
)]
pub struct MonitorJobArguments {
    /// The grid or surface (.vtu .pvtu .vtp .pvtp .vtk), or a step of a series (.pvd)
    ///
    /// Its solids are judged, or if it has none its two-dimensional cells.
    pub input: PathBuf,

    /// The grid with the monitor as a cell array: .vtu
    ///
    /// Cells that could not be judged are NaN there, and counted. A cell that is no triangle or
    /// tetrahedron has the sum of its parts' numbers ('defect', 'area'), or their mean by size
    /// ('stepwise', 'interpolation').
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    #[command(flatten)]
    pub monitor: MonitorArguments,

    /// Name of the cell array [default: DefectMonitor, AreaMonitor, StepwiseMonitor or
    /// InterpolationMonitor]; with --select the array of marks (1: selected) has 'Marks' after it
    #[arg(long, value_name = "NAME", help_heading = "Output")]
    pub name: Option<String>,

    /// Write the summary as JSON: cells, sum, mean, largest, not_judged, selected
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub stats: Option<PathBuf>,

    /// Encoding of the arrays in the output
    #[arg(
        long, value_name = "E", value_enum, default_value_t = names::EncodingName::Raw,
        help_heading = "Output"
    )]
    encoding: names::EncodingName,

    #[command(flatten)]
    pub scalars: ScalarArguments,

    #[command(flatten)]
    pub interpolant: InterpolantArguments,

    #[command(flatten)]
    pub running: RunArguments,
}

const MONITOR_EXAMPLES: &str = "\
\x1b[1;32mExamples:\x1b[0m
  The defect, with the cells above twice its average marked:
    vtu2contour monitor in.vtu -o out.vtu -m defect --pde 'uxx + uyy = -k*u' \\
      --param k=20 --select average:2

  Without a PDE, and the fewest cells with half of it all, for 'refine --marks':
    vtu2contour monitor in.vtu -o out.vtu -m interpolation --name eta --select bulk:0.5
    vtu2contour refine out.vtu -o finer.vtu --marks etaMarks";

impl MonitorJobArguments {
    /// What the arguments ask for.
    pub fn options(&self) -> MonitorOptions {
        MonitorOptions {
            monitor: self.monitor.monitor(),
            samples: self.monitor.samples,
            selection: self.monitor.select,
            name: self.name.clone(),
        }
    }

    /// What the arguments say of the solution.
    pub fn solution(&self) -> ContourOptions {
        self.interpolant.options(self.scalars.options())
    }

    /// How files are written.
    pub fn write_options(&self) -> WriteOptions {
        WriteOptions { encoding: self.encoding.into(), ..WriteOptions::default() }
    }
}

const REFINE_EXAMPLES: &str = "\
\x1b[1;32mExamples:\x1b[0m
  The cells with the largest half of an error indicator, as its sum goes:
    vtu2contour refine in.vtu -o out.vtu --by eta --select bulk:0.5

  Five steps, with a program that solves on each mesh and writes eta:
    vtu2contour refine in.vtu -o out.vtu --by eta --select bulk:0.5 --steps 5 \\
      --solver 'python solve.py {input} {output}'

  Exactly 2500 points, where the PDE is met least:
    vtu2contour refine in.vtu -o out.vtu -m defect --pde 'uxx + uyy = -6' --max-points 2500

  The thesis' hybrid, with new boundary points on a circle and the regions' borders kept:
    vtu2contour refine in.vtu -o out.vtu --by eta --method delaunay --regions material \\
      --boundary circle.vtp";

/// Sweeps of smoothing, at most: more move points by little.
const SWEEPS: usize = 10;

/// Arguments of `refine`.
#[derive(Debug, Args)]
#[command(
    group = clap::ArgGroup::new("marking").required(true).args(["marks", "by", "monitor"]),
    after_help = REFINE_EXAMPLES
)]
pub struct RefineArguments {
    /// The grid (.vtu .pvtu .vtp .pvtp .vtk), or a step of a series (.pvd)
    ///
    /// Its solids are refined, or if it has none its two-dimensional cells. All become
    /// tetrahedra or triangles first.
    pub input: PathBuf,

    /// The refined mesh: .vtu
    ///
    /// New points have the solution's value and gradient of its cubics, other point arrays are
    /// interpolated linearly, cells have the data of those they are part of. OriginalCellIds
    /// says which these are, ParentEdge between which two points a new point was put (-1: not
    /// new, or inside a cell).
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    /// Refine the cells with another number than 0 in this cell array
    ///
    /// In several steps their parts are refined again.
    #[arg(
        long, value_name = "NAME", help_heading = "Where",
        conflicts_with_all = ["select", "samples", "second"]
    )]
    pub marks: Option<String>,

    /// Refine by the numbers of this cell array, such as an error indicator: see --select, which
    /// is average:2 if not given
    #[arg(
        long, value_name = "NAME", help_heading = "Where", conflicts_with_all = ["samples", "second"]
    )]
    pub by: Option<String>,

    #[command(flatten)]
    pub monitor: MonitorArguments,

    /// How triangles are divided; tetrahedra are always bisected
    #[arg(
        long, value_name = "M", value_enum, default_value_t = names::RefineMethodName::Bisect,
        help_heading = "Refinement"
    )]
    method: names::RefineMethodName,

    /// Move the points of triangles after they were divided, so that these have better shapes.
    /// Points on the boundary and between --regions stay
    #[arg(long, value_name = "S", value_enum, help_heading = "Refinement")]
    smooth: Option<names::SmoothingName>,

    /// Cell array whose numbers tell regions: 'delaunay' and --smooth keep the edges between
    /// them; division keeps all sides of cells anyway
    #[arg(long, value_name = "NAME", help_heading = "Refinement")]
    pub regions: Option<String>,

    /// Curved boundary, as lines or polylines of a file (.vtp .vtu .vtk); may be repeated.
    /// 'delaunay' puts new boundary points on it
    ///
    /// For sides of cells that have both ends on the curve, to a hundredth of their length. A
    /// new point is halfway along the curve. Interfaces between --regions may be curved too.
    #[arg(long = "boundary", value_name = "FILE", help_heading = "Refinement")]
    pub boundaries: Vec<PathBuf>,

    /// The most points that the refined mesh may have
    ///
    /// With --monitor and without --steps, so many steps are made as it takes to have them, in
    /// which average:K selects the cells above the average where none are above K times that.
    /// With triangles the number is met exactly if as many are asked for (by 'red-green' on
    /// meshes of more than a few triangles); with tetrahedra nearly.
    #[arg(long, value_name = "N", help_heading = "Refinement")]
    pub max_points: Option<usize>,

    /// So many steps of refinement, each of the mesh of the one before [default: 1, or with
    /// --monitor and --max-points as many as it takes]
    #[arg(
        long, value_name = "N", help_heading = "Refinement",
        value_parser = clap::value_parser!(u16).range(1..=i64::from(MOST_STEPS))
    )]
    steps: Option<u16>,

    /// A command that solves on a mesh: run after each step, and before the first if the array
    /// of --by is not there
    ///
    /// A shell runs it. {input} stands for a .vtu with the mesh and its data, {output} for the
    /// .vtu that the command writes: the same points and cells, with its own arrays. If it
    /// fails, the last mesh that it solved on is written.
    #[arg(long, value_name = "COMMAND", help_heading = "Refinement")]
    pub solver: Option<String>,

    #[command(flatten)]
    pub scalars: ScalarArguments,

    #[command(flatten)]
    pub interpolant: InterpolantArguments,

    /// Encoding of the arrays in the output, and in what the solver reads
    #[arg(
        long, value_name = "E", value_enum, default_value_t = names::EncodingName::Raw,
        help_heading = "Output"
    )]
    encoding: names::EncodingName,

    #[command(flatten)]
    pub running: RunArguments,
}

/// Steps of refinement at most.
const MOST_STEPS: u16 = 1000;

impl RefineArguments {
    /// How many steps are made at most.
    pub fn steps(&self) -> u16 {
        let goes_on = self.monitor.monitor.is_some() && self.max_points.is_some();
        self.steps.unwrap_or(if goes_on { MOST_STEPS } else { 1 })
    }

    /// What the arguments ask for.
    ///
    /// `boundaries`: the curves of the files.
    pub fn options(&self, boundaries: Vec<Vec<Vector>>) -> RefineOptions {
        let selection = self.monitor.select.unwrap_or_default();
        let marked = match (&self.marks, &self.by) {
            (Some(name), _) => MarkedBy::Marks(name.clone()),
            (None, Some(name)) => MarkedBy::Array(name.clone(), selection),
            (None, None) => {
                MarkedBy::Monitor(self.monitor.monitor(), self.monitor.samples, selection)
            }
        };
        RefineOptions {
            method: self.method.into(),
            marked,
            smoothing: self.smooth.map(|name| (name.into(), SWEEPS)),
            max_points: self.max_points,
            regions: self.regions.clone(),
            boundaries,
            solution: self.interpolant.options(self.scalars.options()),
        }
    }

    /// How files are written.
    pub fn write_options(&self) -> WriteOptions {
        WriteOptions { encoding: self.encoding.into(), ..WriteOptions::default() }
    }
}

/// Arguments of `contour`.
#[derive(Debug, Args)]
pub struct ContourArguments {
    // both are optional by type alone: with a subcommand they are not asked for
    /// The grid or surface (.vtu .pvtu .vtp .pvtp .vtk), or a series of them (.pvd)
    ///
    /// What a file is is known by its content, not by its name. Pieces (.pvtu, .pvtp) are
    /// joined, unless the output is a .pvtp, or with --stream.
    #[arg(required = true)]
    input: Option<PathBuf>,

    /// The lines: .vtp for ParaView, VTK and pyvista, .vtu for tools that read no .vtp,
    /// .svg for a picture; .pvd of a series, .pvtp in pieces
    ///
    /// A .pvd lists one .vtp for each file of the series, with its time. A .pvtp lists one
    /// .vtp for each piece of a .pvtu or .pvtp, and the pieces are read one at a time. The
    /// listed files are put in a folder beside the list: out.pvd lists out/out_0.vtp,
    /// out/out_1.vtp and so on. All files appear together, or none.
    #[arg(short, long, value_name = "FILE", required = true)]
    output: Option<PathBuf>,

    #[command(flatten)]
    pub scalars: ScalarArguments,

    #[command(flatten)]
    pub levels: LevelArguments,

    #[command(flatten)]
    pub interpolant: InterpolantArguments,

    #[command(flatten)]
    pub lines: LineArguments,

    #[command(flatten)]
    pub surfaces: SurfaceArguments,

    #[command(flatten)]
    pub output_options: OutputArguments,

    /// Take the pieces of a .pvtu or .pvtp one at a time: the memory is that of the largest of
    /// them, and of the contours
    ///
    /// The contours are the same, but for what each piece decides by itself: whether a gradient
    /// array fits, which is told if they differ, and the PDE's equations in solids. Points of
    /// single precision become double beside those of double. Each piece is read twice: first for
    /// the size of the whole, and its range where that decides the levels. For a .pvtp all this is
    /// done anyway, and there the memory does not depend on the contours either. Of a series (.pvd)
    /// choose a step, with --time.
    #[arg(
        long, help_heading = "Running", conflicts_with_all = ["triangles", "merge_points"]
    )]
    pub stream: bool,

    #[command(flatten)]
    pub running: RunArguments,
}

impl ContourArguments {
    /// The file to read.
    pub fn input(&self) -> &Path {
        self.input.as_deref().unwrap_or(Path::new(""))
    }

    /// The file to write.
    pub fn output(&self) -> &Path {
        self.output.as_deref().unwrap_or(Path::new(""))
    }

    /// What the arguments ask the filter to do.
    pub fn options(&self) -> ContourOptions {
        let Self { levels, interpolant, lines, surfaces, output_options, .. } = self;
        ContourOptions {
            levels: levels.levels(),
            method: lines.method.into(),
            spacing: lines.spacing,
            tolerance: lines.tolerance,
            points_per_side: surfaces.nside,
            triangles: surfaces.triangles,
            single: output_options.single(),
            segments: output_options.segments,
            gradients: output_options.gradients,
            normals: output_options.normals,
            ..interpolant.options(self.scalars.options())
        }
    }
}
