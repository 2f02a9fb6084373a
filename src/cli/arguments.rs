//! What can be said on the command line.

use std::path::{Path, PathBuf};

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use vtu2contour::contour::Levels;
use vtu2contour::contour::lines::Method;
use vtu2contour::filter::{Component, ContourOptions, GradientSource, InterpolantKind};
use vtu2contour::interpolant::Predictor;
use vtu2contour::vtk::{Encoding, Floats, WriteOptions};

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

  With the PDE that the solution satisfies, which makes the cubics fourth order:
    vtu2contour solution.vtu -o lines.vtp --pde 'uxx + uyy = -k*u' --param k=20

  What is in a file, and what would be contoured:
    vtu2contour info solution.vtu

Without a gradient array (say where it is with -g) gradients are recovered from
the values. 'vtu2contour --help' explains every option.";

/// Contour lines of a finite-element solution, as accurate as its data.
///
/// Reads an unstructured grid (.vtu) with values and gradients at its points,
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
    /// Print completions for a shell, to be sourced by it
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// Arguments of `info`.
#[derive(Debug, Args)]
pub struct InfoArguments {
    /// The grid (.vtu)
    pub input: PathBuf,

    #[command(flatten)]
    pub scalars: ScalarArguments,
}

/// Which array.
#[derive(Debug, Args)]
#[command(next_help_heading = "What to contour")]
pub struct ScalarArguments {
    /// Point array to contour [default: the active scalars, else the only scalar array]
    #[arg(short, long, value_name = "NAME")]
    pub array: Option<String>,

    /// Component of a vector array, from 0, or its length
    #[arg(long, value_name = "N|mag", value_parser = component)]
    pub component: Option<Component>,

    /// Point array with the gradient, or 'recover' to recover it from the values
    /// [default: an array with a usual name, such as 'gradient' or 'grad_u', else recovered]
    #[arg(short, long, value_name = "NAME")]
    pub gradient: Option<String>,
}

/// Arguments of `contour`.
#[derive(Debug, Args)]
pub struct ContourArguments {
    // both are optional by type alone: with a subcommand they are not asked for
    /// The grid (.vtu)
    #[arg(required = true)]
    input: Option<PathBuf>,

    /// The lines: .vtp for ParaView, VTK and pyvista, .vtu for tools that read no .vtp,
    /// .svg for a picture
    #[arg(short, long, value_name = "FILE", required = true)]
    output: Option<PathBuf>,

    #[command(flatten)]
    pub scalars: ScalarArguments,

    /// Make points one that are no further apart than this, in the mesh's unit; 0 (or no
    /// number) for points at exactly the same place, as discontinuous elements have them
    #[arg(
        long, value_name = "TOL", num_args = 0..=1, default_missing_value = "0",
        help_heading = "What to contour", value_parser = not_negative
    )]
    merge_points: Option<f64>,

    #[command(flatten)]
    pub levels: LevelArguments,

    #[command(flatten)]
    pub interpolant: InterpolantArguments,

    #[command(flatten)]
    pub lines: LineArguments,

    #[command(flatten)]
    pub output_options: OutputArguments,

    #[command(flatten)]
    pub running: RunArguments,
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

    /// Which interpolant to contour
    #[arg(long, value_name = "I", value_enum, default_value_t = Interpolant::Pci)]
    pub interpolant: Interpolant,

    /// Where the PDE's right-hand side takes the solution from
    #[arg(long, value_name = "P", value_enum, default_value_t = PredictorName::Quadratic)]
    pub predictor: PredictorName,
}

/// How lines are drawn.
#[derive(Debug, Args)]
#[command(next_help_heading = "Lines")]
pub struct LineArguments {
    /// How curves between the edges of cells are found
    #[arg(long, value_name = "M", value_enum, default_value_t = MethodName::Aodea)]
    pub method: MethodName,

    /// Greatest distance of a segment from the contour, in the mesh's unit
    /// [default: 1e-5 of the bounding box's diagonal]
    #[arg(long, value_name = "T", value_parser = positive)]
    pub tolerance: Option<f64>,

    /// Greatest distance between neighbouring points, in the mesh's unit
    #[arg(long, value_name = "D", value_parser = positive)]
    pub spacing: Option<f64>,
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

    /// Encoding of the .vtp
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

/// Names of the interpolants.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Interpolant {
    /// The pure cubic interpolant
    Pci,
    /// Linear, as VTK's own filter
    Linear,
}

/// Names of the predictors.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum PredictorName {
    /// From the cubic that reproduces quadratics
    Quadratic,
    /// From the linear interpolant, as in the thesis
    Linear,
}

/// Names of the methods.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum MethodName {
    /// Points on the contour, joined by straight lines
    Intercept,
    /// Curves y(x) or x(y)
    Sode,
    /// Curves by arc length
    Odea,
    /// Curves by arc length, as many as the tolerance asks for
    Aodea,
}

/// Names of the encodings.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum EncodingName {
    /// Bytes, appended
    Raw,
    /// Compressed by zlib, appended
    Zlib,
    /// Compressed by LZ4, appended
    Lz4,
    /// Base64 inside the XML
    Base64,
    /// Numbers as text
    Ascii,
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
            ..ContourOptions::default()
        }
    }
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
        let Self { levels, interpolant, lines, output_options, .. } = self;
        ContourOptions {
            merge_points: self.merge_points,
            levels: levels.levels(),
            method: lines.method.into(),
            spacing: lines.spacing,
            tolerance: lines.tolerance,
            interpolant: match interpolant.interpolant {
                Interpolant::Pci => InterpolantKind::Pci,
                Interpolant::Linear => InterpolantKind::Linear,
            },
            pde: interpolant.pde.clone(),
            parameters: interpolant.parameters.clone(),
            predictor: match interpolant.predictor {
                PredictorName::Quadratic => Predictor::Quadratic,
                PredictorName::Linear => Predictor::Linear,
            },
            single: output_options.single(),
            segments: output_options.segments,
            gradients: output_options.gradients,
            normals: output_options.normals,
            ..self.scalars.options()
        }
    }
}

impl LevelArguments {
    fn levels(&self) -> Levels {
        if self.values.is_empty() {
            Levels::Equal { count: usize::from(self.levels), range: self.range }
        } else {
            Levels::Explicit(self.values.clone())
        }
    }
}

impl OutputArguments {
    fn single(&self) -> Option<bool> {
        match (self.single, self.double) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    /// How the .vtp is written.
    pub fn write_options(&self) -> WriteOptions {
        let encoding = match self.encoding {
            EncodingName::Raw => Encoding::Raw,
            EncodingName::Zlib => Encoding::Zlib,
            EncodingName::Lz4 => Encoding::Lz4,
            EncodingName::Base64 => Encoding::Base64,
            EncodingName::Ascii => Encoding::Ascii,
        };
        let floats = match self.single() {
            Some(true) => Floats::Single,
            Some(false) => Floats::Double,
            None => Floats::AsGiven,
        };
        WriteOptions { encoding, floats }
    }
}

impl From<MethodName> for Method {
    fn from(name: MethodName) -> Method {
        match name {
            MethodName::Intercept => Method::Intercept,
            MethodName::Sode => Method::Sode,
            MethodName::Odea => Method::Odea,
            MethodName::Aodea => Method::Aodea,
        }
    }
}

fn component(text: &str) -> Result<Component, String> {
    match text {
        "mag" => Ok(Component::Magnitude),
        number => number
            .parse()
            .map(Component::Number)
            .map_err(|_| "give the component's number, from 0, or 'mag'".to_owned()),
    }
}

fn level(text: &str) -> Result<f64, String> {
    let value: f64 = text.trim().parse().map_err(|_| "not a number".to_owned())?;
    if value.is_finite() { Ok(value) } else { Err("not a finite number".to_owned()) }
}

fn positive(text: &str) -> Result<f64, String> {
    let value = level(text)?;
    if value > 0.0 { Ok(value) } else { Err("not above zero".to_owned()) }
}

fn not_negative(text: &str) -> Result<f64, String> {
    let value = level(text)?;
    if value >= 0.0 { Ok(value) } else { Err("below zero".to_owned()) }
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let (low, high) = text.split_once(',').ok_or("give two numbers, as LO,HI")?;
    let (low, high) = (level(low)?, level(high)?);
    if low < high { Ok([low, high]) } else { Err("LO must be below HI".to_owned()) }
}

fn parameter(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("give a name and a number, as NAME=V")?;
    Ok((name.trim().to_owned(), level(value)?))
}
