//! Why a grid cannot be contoured.

use thiserror::Error;

use crate::contour::LevelError;
use crate::contour::surface::MOST_POINTS;
use crate::mesh::MeshError;
use crate::monitor::SelectionError;
use crate::pde::PdeError;
use crate::refine::RefineError;
use crate::refine::delaunay::DelaunayError;
use crate::simplices::{CellCounts, LeftOut, SplitError};

/// Why a grid cannot be contoured: one line that says what to do.
#[derive(Clone, Debug, Error)]
#[allow(missing_docs)] // the messages say what the fields are
pub enum FilterError {
    #[error("no point array '{name}'; the point arrays are {available}")]
    NoSuchArray { name: String, available: String },

    #[error(
        "array '{name}' belongs to the cells, and contours need values at the points: convert it \
         first, for example with ParaView's Cell Data to Point Data"
    )]
    CellArray { name: String },

    #[error("which array? give --array NAME; the point arrays are {available}")]
    AmbiguousArray { available: String },

    #[error(
        "there are no point arrays to contour{}",
        if *cell_arrays { ", only cell arrays: convert one first, for example with ParaView's Cell \
        Data to Point Data" } else { "" }
    )]
    NoPointArrays { cell_arrays: bool },

    #[error(
        "array '{name}' has {components} components: choose one with --component 0..{}, or its \
         length with --component mag", components - 1
    )]
    NoComponent { name: String, components: usize },

    #[error("array '{name}' has no component {component}, it has {components} (counted from 0)")]
    NoSuchComponent { name: String, component: usize, components: usize },

    #[error("array '{name}' holds text, not numbers")]
    NotNumbers { name: String },

    #[error(
        "array '{name}' cannot be the gradient: it has {components} component{}, and {expected} \
         are needed", if *components == 1 { "" } else { "s" }
    )]
    GradientShape { name: String, components: usize, expected: String },

    #[error(
        "the gradient '{name}' must be one array of vectors, or two or three arrays of one component"
    )]
    GradientParts { name: String },

    #[error("no cell holds a finite value of '{name}': there is nothing to contour")]
    NoValues { name: String },

    #[error("all cells are ghosts, which belong to other processes: there is nothing to contour")]
    OnlyGhosts,

    #[error(
        "nothing to contour: the grid has {cells}, and only two- and three-dimensional cells are contoured{}",
        if left_out.total() == 0 { String::new() } else { format!("; left out: {left_out}") }
    )]
    NoCells { cells: CellCounts, left_out: LeftOut },

    #[error(transparent)]
    Split(#[from] SplitError),

    #[error("--pde: {0}")]
    Pde(#[from] PdeError),

    #[error("--pde: '{name}' {cure}")]
    PdeName { name: String, cure: String },

    #[error(transparent)]
    Level(#[from] LevelError),

    #[error(transparent)]
    Mesh(#[from] MeshError),

    #[error(
        "there must be one of the {what} for each point: there are {count}, and {points} points"
    )]
    NotOneAPoint { what: &'static str, count: usize, points: usize },

    #[error("{option} must be a positive number, not {value:?}")]
    NotPositive { option: &'static str, value: f64 },

    #[error("--nside must be 2 to {MOST_POINTS}, not {points}")]
    PointsPerSide { points: u32 },

    #[error("give one of --tolerance, --nside and --triangles, not several")]
    TwoFinenesses,

    #[error("--merge-points {value:?} must be a length: zero, or above it")]
    MergeTolerance { value: f64 },

    #[error(
        "{option} {value:e} is too small: below {least:e}, a millionth of the size of the mesh, \
         lines would have millions of points"
    )]
    TooSmall { option: &'static str, value: f64, least: f64 },

    #[error("the refined grid would have {cells} cells, more than {most}: refine it less")]
    TooManyCells { cells: usize, most: usize },

    #[error("no cell array '{name}'; the cell arrays are {available}")]
    NoSuchCellArray { name: String, available: String },

    #[error("cell array '{name}' cannot mark cells: one number for each is needed")]
    NotOneACell { name: String },

    #[error(transparent)]
    Refine(#[from] RefineError),

    #[error(transparent)]
    Delaunay(#[from] DelaunayError),

    #[error("--select: {0}")]
    Selection(#[from] SelectionError),

    #[error("there are no lines: a boundary is given as lines or polylines")]
    NoLines,

    #[error(
        "--boundary is for triangles by --method delaunay: other methods put new points on the \
         sides of cells"
    )]
    UnusedBoundary,

    #[error("--pde is for the interpolant pci: leave --pde or --interpolant out")]
    UnusedPde,

    #[error("{what} needs the PDE: give --pde EQUATION, such as 'uxx + uyy = -k*u'")]
    NeedsPde { what: String },

    #[error("there is no interpolant '{name}' on {cells} cells: choose one of {others}")]
    NotOnCells { name: &'static str, cells: &'static str, others: &'static str },

    #[error(
        "a tolerance is kept by interpolants that are continuous, and '{name}' is not: say by \
         --subdivide into how many parts edges are divided"
    )]
    NotContinuous { name: &'static str },

    #[error(
        "the second interpolant '{name}' is the interpolant itself: choose another, or leave --interpolant out"
    )]
    SameInterpolant { name: &'static str },

    #[error(
        "this monitor compares interpolants of values and gradients, and the linear one uses no \
         gradients: leave --interpolant out, or choose the monitor 'area'"
    )]
    NothingToCompare,
}

impl FilterError {
    /// Whether the grid has nothing that could hold a contour. One of several grids may be
    /// so; for a single one it is an error.
    pub fn is_nothing_to_contour(&self) -> bool {
        matches!(self, Self::NoCells { .. } | Self::NoValues { .. } | Self::OnlyGhosts)
    }
}
