//! Contour lines of coarse finite-element solutions, as accurate as the data.
//!
//! A finite-element solution carries values *and gradients* at its nodes, and
//! often its differential equation is known too. The Differential Equation
//! Interpolant (DEI) turns them into one cubic polynomial per cell, and this
//! crate draws the contours of that cubic, not of a linear mesh.
//!
//! The crate is a house of floors; each uses only those below it (ARCHITECTURE.md
//! draws it, and follows one contour through it):
//!
//! | floor | what it knows |
//! |---|---|
//! | [`filter`] | a grid with data in, lines with data out |
//! | [`contour`] | levels, ranges of cells, contour lines |
//! | [`monitor`] | where the mesh should be finer |
//! | [`refine`] | meshes made finer there |
//! | [`interpolant`] | values, gradients and PDE become cubics |
//! | [`field`] | values and gradients at points; recovery |
//! | [`pde`] | differential equations given as text |
//! | [`simplices`] | VTK's cells as triangles and tetrahedra |
//! | [`mesh`] | points, triangles, tetrahedra, frames, neighbours, location |
//! | [`svg`] | pictures |
//! | [`vtk`] | the VTK file formats |
//! | [`bernstein`] | polynomials on simplices, their bounds and roots |
//!
//! From an array of values to contour lines, without files:
//!
//! ```
//! use vtu2contour::contour::CellRanges;
//! use vtu2contour::contour::lines::{Method, Resolution, contour_lines};
//! use vtu2contour::field::Field;
//! use vtu2contour::interpolant::Pci;
//! use vtu2contour::mesh::{TriangleMesh, Vector};
//!
//! // u = x² + y² on two triangles
//! let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
//! let points: Vec<Vector> = points.iter().map(|p| Vector::new(p[0], p[1], 0.0)).collect();
//! let values: Vec<f64> = points.iter().map(Vector::norm_squared).collect();
//! let gradients: Vec<Vector> = points.iter().map(|p| p * 2.0).collect();
//! let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 2, 3]])?;
//!
//! let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
//! let ranges = CellRanges::new(&pci);
//! let fine = Resolution { spacing: f64::INFINITY, tolerance: 1e-5 };
//! let lines = contour_lines(&pci, &ranges, &[0.25], Method::Aodea, fine);
//!
//! // a quarter of the circle of radius 1/2
//! assert_eq!(lines.lines.len(), 1);
//! assert!(lines.points.iter().all(|p| (p.position.norm() - 0.5).abs() < 1e-14));
//! # Ok::<(), vtu2contour::mesh::MeshError>(())
//! ```

pub mod bernstein;
pub mod contour;
pub mod field;
pub mod filter;
pub mod interpolant;
pub mod interruption;
mod large_pages;
pub mod mesh;
pub mod monitor;
pub mod pde;
pub mod refine;
pub mod simplices;
pub mod svg;
pub mod vtk;

/// The README's example compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
