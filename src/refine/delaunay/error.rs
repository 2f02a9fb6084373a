//! Why a mesh cannot be refined by Delaunay's triangulation.

use thiserror::Error;

use crate::refine::RefineError;

/// Why a mesh cannot be refined by Delaunay's triangulation: one line that says what to do.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)] // the messages say what the fields are
pub enum DelaunayError {
    #[error(transparent)]
    Marks(#[from] RefineError),

    #[error("there are {regions} regions, and {cells} cells: give one a cell")]
    Regions { regions: usize, cells: usize },

    #[error(
        "point {point} does not lie in the plane of the others, and Delaunay's triangulation is \
         one of the plane: refine by bisection"
    )]
    NotInPlane { point: u32 },

    #[error("the mesh's coordinates are above 1e60: scale it first")]
    TooLarge,

    #[error("cell {cell} has no area: remove it, or refine by bisection")]
    NoArea { cell: u32 },

    #[error(
        "points {first} and {second} are at the same place: merge them first (a slit with two \
         sides can be refined by bisection)"
    )]
    DuplicatePoints { first: u32, second: u32 },

    #[error(
        "the edge from point {} to point {} crosses another one, or runs through a point: the \
         cells lie over one another, or do not fit together", ends[0], ends[1]
    )]
    CrossingEdges { ends: [u32; 2] },

    #[error(
        "no edge of the boundary or between regions lies on the given curves: each has both ends \
         further from all of them than a hundredth of its length"
    )]
    NoEdgeOnCurves,

    #[error("the edge from point {} to point {} belongs to three cells or more", ends[0], ends[1])]
    Branching { ends: [u32; 2] },

    #[error(
        "the boundary touches itself at point {point}: two holes, or parts of the domain, meet \
         there. Separate them, or refine by bisection"
    )]
    TouchingBoundaries { point: u32 },
}

impl DelaunayError {
    /// The same with the mesh's numbers of points, `used` of those that cells use.
    pub(super) fn renumbered(self, used: &[u32]) -> Self {
        let number = |point: u32| used.get(point as usize).copied().unwrap_or(point);
        match self {
            Self::DuplicatePoints { first, second } => {
                Self::DuplicatePoints { first: number(first), second: number(second) }
            }
            Self::CrossingEdges { ends } => Self::CrossingEdges { ends: ends.map(number) },
            Self::Branching { ends } => Self::Branching { ends: ends.map(number) },
            other => other,
        }
    }
}
