//! The continuous tri-cubic on tetrahedra.
//!
//! Values and gradients at the four vertices give 16 of the 20 Bernstein coefficients.
//! The other four belong to the faces. The thesis (section 1.8) takes them from the PDE
//! in each tetrahedron for itself, so two neighbours disagree on their common face.
//! Here a face has one number, whatever the tetrahedron that asks for it, and the
//! interpolant is continuous everywhere.
//!
//! Without a PDE that number is taken from the face's own data, such that quadratics
//! are reproduced. With one, the numbers of all faces are chosen together to meet the
//! equations of all tetrahedra as well as possible, by least squares.

use rayon::prelude::*;

use super::TetrahedronCubics;
use super::equation::Equation;
use super::face_equations::{FaceEquations, face_equations};
use super::hermite::{hermite, quadratic_precision};
use super::least_squares::least_squares;
use crate::bernstein::TetrahedronCubic;
use crate::field::Field;
use crate::mesh::{Faces, TetrahedronMesh};
use crate::pde::LANES;

/// The tri-cubic interpolant of a field on a mesh of tetrahedra.
///
/// Its error is of third order without a PDE and of fourth with one, on meshes whose
/// tetrahedra keep their shape.
#[derive(Clone, Debug)]
pub struct Tricubic<'a> {
    mesh: &'a TetrahedronMesh,
    field: Field<'a>,
    /// With a PDE: the coefficients amid the faces of each tetrahedron.
    faces: Option<Vec<[f64; 4]>>,
    singular: usize,
}

/// Tetrahedra collocated at a time by one thread: whole batches of the PDE.
const CHUNK: usize = LANES;

impl<'a> Tricubic<'a> {
    /// The interpolant of values and gradients alone. It reproduces quadratics.
    ///
    /// `field` has one value and one gradient for each point of `mesh`. Nothing is
    /// stored: all coefficients are read off the field.
    pub fn new(mesh: &'a TetrahedronMesh, field: Field<'a>) -> Self {
        Self { mesh, field, faces: None, singular: 0 }
    }

    /// The interpolant that also satisfies a PDE, as well as one cubic a tetrahedron can
    /// without cracks.
    ///
    /// It reproduces quadratics if they solve the PDE, and any cubic that solves it if
    /// the PDE determines it (the Laplacian does) and `g` does not depend on the
    /// solution. It is the same for any number of threads.
    pub fn with_pde(mesh: &'a TetrahedronMesh, field: Field<'a>, equation: &Equation) -> Self {
        let tetrahedra: Vec<usize> = (0..mesh.tetrahedra().len()).collect();
        let equations: Vec<Option<FaceEquations>> = tetrahedra
            .par_chunks(CHUNK)
            .flat_map_iter(|chunk| face_equations(mesh, &field, equation, chunk))
            .collect();
        let singular = equations.iter().filter(|equations| equations.is_none()).count();
        let equations = equations.into_iter().map(Option::unwrap_or_default).collect();
        let numbered = Faces::new(mesh);
        let corrections = least_squares(&numbered, equations);
        let corrected = |(tetrahedron, faces): (usize, &[u32; 4])| {
            let start = quadratic_precision(mesh, &field, tetrahedron);
            [0, 1, 2, 3].map(|opposite| {
                let position = TetrahedronCubic::FACES[opposite];
                start.coefficients[position] + corrections[faces[opposite] as usize]
            })
        };
        let faces = numbered.of_tetrahedra().par_iter().enumerate().map(corrected).collect();
        Self { mesh, field, faces: Some(faces), singular }
    }

    /// How many tetrahedra could not use the PDE, because it says nothing of the face
    /// coefficients there or is not a finite number. Their faces follow the neighbours;
    /// a face of such tetrahedra alone reproduces quadratics.
    pub fn singular(&self) -> usize {
        self.singular
    }
}

impl TetrahedronCubics for Tricubic<'_> {
    fn mesh(&self) -> &TetrahedronMesh {
        self.mesh
    }

    fn cubic(&self, tetrahedron: usize) -> TetrahedronCubic {
        match &self.faces {
            Some(faces) => hermite(self.mesh, &self.field, tetrahedron, faces[tetrahedron]),
            None => quadratic_precision(self.mesh, &self.field, tetrahedron),
        }
    }
}
