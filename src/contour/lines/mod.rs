//! Contour lines on triangles.

mod arc;
mod bezier;
mod contour_lines;
mod crossing;
mod curve;
mod hermite;
mod intercept;
mod method;
mod piece;
mod situation;
mod start;
mod stitch;
mod trace;

pub use bezier::Bezier;
pub use contour_lines::{ContourLines, Counts, LinePoint, Polyline, contour_lines};
pub use crossing::Owner;
pub use curve::Resolution;
pub use method::Method;
