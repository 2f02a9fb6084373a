//! Contours of an interpolant: nothing here knows a file or a PDE.
//!
//! The three stages of the thesis (section 2.3):
//!
//! 1. [`CellRanges`]: bounds of the cubic on each cell, so that cells without a
//!    contour are passed over;
//! 2. [`lines`]: crossings on the edges, and subdivision until every piece holds
//!    one simple arc (certified, so nothing is missed);
//! 3. the curve through each piece, by one of four methods, and the arcs joined
//!    into polylines.

mod block_ranges;
mod components;
mod crossings;
mod extreme;
mod extreme_in_tetrahedron;
mod levels;
pub mod lines;
mod ranges;
mod rounding;
pub mod surface;

pub use block_ranges::BlockRanges;
pub use extreme::{Extreme, recursive_extreme};
pub use extreme_in_tetrahedron::recursive_extreme_in_tetrahedron;
pub use levels::{LevelError, Levels};
pub(crate) use ranges::holds;
pub use ranges::{CellCubic, CellRanges, holds_any};
