//! Contour lines of coarse finite-element solutions, as accurate as the data.
//!
//! A finite-element solution carries values *and gradients* at its nodes, and
//! often its differential equation is known too. The Differential Equation
//! Interpolant (DEI) turns them into one cubic polynomial per cell, and this
//! crate draws the contours of that cubic, not of a linear mesh.
//!
//! The crate is a house of floors; each uses only those below it (see
//! ARCHITECTURE.md for the drawing):
//!
//! | floor | what it knows |
//! |---|---|
//! | [`bernstein`] | polynomials on simplices, their bounds and roots |
//! | [`vtk`] | the VTK file formats |
//! | [`pde`] | differential equations given as text |

pub mod bernstein;
pub mod contour;
pub mod field;
pub mod filter;
pub mod interpolant;
pub mod mesh;
pub mod pde;
pub mod svg;
pub mod vtk;
