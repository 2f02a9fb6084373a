//! Cubic polynomials in Bernstein form on a segment and on a triangle.
//!
//! Every interpolant of this crate ends as Bernstein coefficients, because in
//! that form the questions of contouring have short and certain answers:
//!
//! - a polynomial lies between its least and its greatest coefficient
//!   ([`TriangleCubic::bounds`]), so a cell without a contour is known as such;
//! - the restriction to a line or to a smaller triangle is a convex combination
//!   of coefficients ([`TriangleCubic::restrict`], [`TriangleCubic::sub_triangle`]),
//!   so it loses no accuracy;
//! - a single change of sign, layer by layer from a vertex, certifies that every
//!   ray from that vertex meets the zero set exactly once ([`a_patch`]).
//!
//! This floor knows no mesh: positions are barycentric coordinates.
//!
//! Source: G. Farin, *Curves and Surfaces for CAGD*, chapters 5 and 17 (de
//! Casteljau, blossoms, triangular patches).

pub mod a_patch;
mod barycentric;
mod bounds;
mod factors;
mod roots;
mod segment;
mod sign;
mod tetrahedron;
mod tetrahedron_patch;
mod triangle;

pub use barycentric::{Barycentric, Barycentric4, between, vertices};
pub use bounds::{joined, value_bounds};
pub use roots::{MAX_ROOTS, Root, RootKind, Roots};
pub use segment::SegmentCubic;
pub use sign::Sign;
pub use tetrahedron::TetrahedronCubic;
pub use tetrahedron_patch::PatchCertificate;
pub use triangle::TriangleCubic;
