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

use std::borrow::Cow;

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
    mesh: &'a TetrahedronMesh<'a>,
    field: Field<'a>,
    faces: Cow<'a, FaceCoefficients>,
}

/// What of a tri-cubic interpolant is not read off the field.
#[derive(Clone, Debug, Default)]
pub struct FaceCoefficients {
    /// With a PDE: the coefficients amid the faces of each tetrahedron.
    coefficients: Option<Vec<[f64; 4]>>,
    singular: usize,
}

/// Tetrahedra collocated at a time by one thread: whole batches of the PDE.
const CHUNK: usize = LANES;

impl<'a> Tricubic<'a> {
    /// The interpolant of values and gradients alone. It reproduces quadratics.
    ///
    /// `field` has one value and one gradient for each point of `mesh`. Nothing is
    /// stored: all coefficients are read off the field.
    pub fn new(mesh: &'a TetrahedronMesh<'a>, field: Field<'a>) -> Self {
        Self { mesh, field, faces: Cow::Owned(FaceCoefficients::default()) }
    }

    /// The interpolant that also satisfies a PDE, as well as one cubic a tetrahedron can
    /// without cracks.
    ///
    /// It reproduces quadratics if they solve the PDE, and any cubic that solves it if
    /// the PDE determines it (the Laplacian does) and `g` does not depend on the
    /// solution. It is the same for any number of threads.
    pub fn with_pde(mesh: &'a TetrahedronMesh<'a>, field: Field<'a>, equation: &Equation) -> Self {
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
        let coefficients = numbered.of_tetrahedra().par_iter().enumerate().map(corrected).collect();
        let faces = FaceCoefficients { coefficients: Some(coefficients), singular };
        Self { mesh, field, faces: Cow::Owned(faces) }
    }

    /// The interpolant of which the faces' coefficients are known: those of one of the same
    /// mesh and field.
    pub fn with_faces(
        mesh: &'a TetrahedronMesh,
        field: Field<'a>,
        faces: &'a FaceCoefficients,
    ) -> Self {
        Self { mesh, field, faces: Cow::Borrowed(faces) }
    }

    /// The faces' coefficients, to make the same interpolant of later.
    pub fn into_faces(self) -> FaceCoefficients {
        self.faces.into_owned()
    }

    /// How many tetrahedra could not use the PDE, because it says nothing of the face
    /// coefficients there or is not a finite number. Their faces follow the neighbours;
    /// a face of such tetrahedra alone reproduces quadratics.
    pub fn singular(&self) -> usize {
        self.faces.singular
    }
}

impl TetrahedronCubics for Tricubic<'_> {
    fn mesh(&self) -> &TetrahedronMesh<'_> {
        self.mesh
    }

    fn cubic(&self, tetrahedron: usize) -> TetrahedronCubic {
        match &self.faces.coefficients {
            Some(faces) => hermite(self.mesh, &self.field, tetrahedron, faces[tetrahedron]),
            None => quadratic_precision(self.mesh, &self.field, tetrahedron),
        }
    }
}
