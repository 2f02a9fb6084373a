//! Pictures as SVG documents: lines in a plane, coloured by value.
//!
//! This floor knows no mesh and no contour, only curves in the plane, values and
//! colours. Curves stay cubic Béziers, so a picture is small and smooth at any
//! zoom.

mod colour_bar;
mod colour_map;
mod path;
mod picture;

pub use colour_map::{Colour, viridis};
pub use path::{Curve, Point};
pub use picture::{Coloured, Picture};
