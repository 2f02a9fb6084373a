//! The thesis' own tri-cubic, for comparison: discontinuous.

use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use super::equation::Equation;
use super::face_equations::{FaceEquations, face_equations};
use super::hermite::{hermite, quadratic_precision};
use super::tricubic::CHUNK;
use crate::bernstein::TetrahedronCubic;
use crate::field::Field;
use crate::mesh::TetrahedronMesh;

/// `p3` of the thesis (section 1.8): each tetrahedron satisfies the PDE at four points
/// of its own, and neighbours disagree on their common face.
///
/// It cannot be contoured without cracks, so it is no
/// [`TetrahedronCubics`](super::TetrahedronCubics).
#[derive(Clone, Debug)]
pub struct DiscontinuousTricubic<'a> {
    mesh: &'a TetrahedronMesh<'a>,
    field: Field<'a>,
    /// The coefficients amid the faces of each tetrahedron.
    faces: Vec<[f64; 4]>,
    singular: usize,
}

impl<'a> DiscontinuousTricubic<'a> {
    /// The interpolant of values and gradients that satisfies a PDE at four points of
    /// each tetrahedron.
    ///
    /// `field` has one value and one gradient for each point of `mesh`.
    pub fn with_pde(mesh: &'a TetrahedronMesh<'a>, field: Field<'a>, equation: &Equation) -> Self {
        let tetrahedra: Vec<usize> = (0..mesh.tetrahedra().len()).collect();
        let faces: Vec<([f64; 4], bool)> = tetrahedra
            .par_chunks(CHUNK)
            .flat_map_iter(|chunk| {
                let start = |tetrahedron| quadratic_precision(mesh, &field, tetrahedron);
                let equations = face_equations(mesh, equation, chunk, start);
                chunk.iter().zip(equations).map(|(&tetrahedron, equations)| {
                    let cubic = quadratic_precision(mesh, &field, tetrahedron);
                    let start = TetrahedronCubic::FACES.map(|place| cubic.coefficients[place]);
                    match equations.and_then(|equations| equations.solve()) {
                        Some(x) => ([0, 1, 2, 3].map(|face| start[face] + x[face]), false),
                        None => (start, true),
                    }
                })
            })
            .collect();
        let singular = faces.iter().filter(|(_, singular)| *singular).count();
        let faces = faces.into_iter().map(|(faces, _)| faces).collect();
        Self { mesh, field, faces, singular }
    }

    /// How many tetrahedra could not use the PDE, because it does not determine the four
    /// face coefficients there or is not a finite number. They reproduce quadratics.
    pub fn singular(&self) -> usize {
        self.singular
    }

    /// The cubic on a tetrahedron, its coefficients in the order of the mesh's corners.
    pub fn cubic(&self, tetrahedron: usize) -> TetrahedronCubic {
        hermite(self.mesh, &self.field, tetrahedron, self.faces[tetrahedron])
    }
}

impl FaceEquations {
    /// What meets the four equations, if they determine it.
    fn solve(&self) -> Option<[f64; 4]> {
        let matrix = SMatrix::<f64, 4, 4>::from_fn(|row, face| self.matrix[row][face]);
        let solution = matrix.lu().solve(&SVector::from(self.right))?;
        solution.iter().all(|x| x.is_finite()).then(|| solution.into())
    }
}
