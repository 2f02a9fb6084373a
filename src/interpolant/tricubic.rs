//! The continuous tri-cubic on tetrahedra.
//!
//! Values and gradients at the four vertices give 16 of the 20 Bernstein coefficients.
//! The other four belong to the faces. The thesis (section 1.8) takes them from the PDE
//! in each tetrahedron for itself, so two neighbours disagree on their common face.
//! Here a face has one number, whatever the tetrahedron that asks for it, and the
//! interpolant is continuous everywhere.
//!
//! Without a PDE that number is the one with which the cubics at the face continue into
//! their neighbours (`face_completion`), so that cubics are reproduced, or is taken from
//! the face's own data, such that quadratics are. With a PDE, the numbers of all faces are
//! chosen together to meet the equations of all tetrahedra as well as possible, by least
//! squares.

use std::borrow::Cow;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::TetrahedronCubics;
use super::equation::Equation;
use super::face_completion::{asks_further, estimate, face_corrections};
use super::face_equations::{FaceEquations, face_equations};
use super::hermite::{hermite, hermite_on_edge, quadratic_precision};
use super::least_squares::least_squares;
use super::per_cell::PerCell;
use crate::bernstein::{SegmentCubic, TetrahedronCubic};
use crate::field::Field;
use crate::mesh::{Faces, Subset, TetrahedronMesh};
use crate::pde::LANES;

/// The tri-cubic interpolant of a field on a mesh of tetrahedra.
///
/// Its error is of fourth order on meshes whose tetrahedra keep their shape, of third with
/// quadratic precision.
#[derive(Clone, Debug)]
pub struct Tricubic<'a> {
    mesh: &'a TetrahedronMesh<'a>,
    field: Field<'a>,
    faces: Cow<'a, FaceCoefficients>,
}

/// What of a tri-cubic interpolant is not read off the field.
#[derive(Clone, Debug, Default)]
pub struct FaceCoefficients {
    /// The coefficients amid the faces of each tetrahedron, where they are not those of
    /// quadratic precision.
    coefficients: PerCell<[f64; 4]>,
    singular: usize,
}

/// Tetrahedra collocated at a time by one thread: whole batches of the PDE.
const CHUNK: usize = LANES;

impl<'a> Tricubic<'a> {
    /// The interpolant of values and gradients alone, the face coefficients from the
    /// neighbours.
    ///
    /// It reproduces cubics, but for tetrahedra without a neighbour, which reproduce
    /// quadratics, and for cubics of which a face's own data see next to nothing: the
    /// coefficient amid a face is no farther from that of quadratic precision than the face's
    /// other nine from each other. Its error is of fourth order on meshes whose tetrahedra
    /// keep their shape. It is the same for any number of threads, and for any order of
    /// tetrahedra and their corners.
    ///
    /// `field` has one value and one gradient for each point of `mesh`. Four numbers a
    /// tetrahedron are stored.
    pub fn new(mesh: &'a TetrahedronMesh<'a>, field: Field<'a>) -> Self {
        let coefficients = completed(mesh, &field, &Faces::new(mesh));
        Self::without_pde(mesh, field, PerCell::All(coefficients))
    }

    /// The same in some of the tetrahedra, to the last bit. The others have quadratic
    /// precision, so the interpolant is continuous among those some only.
    ///
    /// It takes time and memory for them and their neighbours alone.
    pub fn in_some(mesh: &'a TetrahedronMesh<'a>, field: Field<'a>, tetrahedra: &Subset) -> Self {
        match completed_in_some(mesh, &field, tetrahedra) {
            Some(completed) => {
                let coefficients = PerCell::Some(tetrahedra.clone(), completed);
                Self::without_pde(mesh, field, coefficients)
            }
            None => Self::new(mesh, field),
        }
    }

    fn without_pde(
        mesh: &'a TetrahedronMesh<'a>,
        field: Field<'a>,
        coefficients: PerCell<[f64; 4]>,
    ) -> Self {
        Self { mesh, field, faces: Cow::Owned(FaceCoefficients { coefficients, singular: 0 }) }
    }

    /// The interpolant of values and gradients alone, each face by itself. It reproduces
    /// quadratics, and its error is of third order.
    ///
    /// `field` has one value and one gradient for each point of `mesh`. Nothing is
    /// stored: all coefficients are read off the field.
    pub fn with_quadratic_precision(mesh: &'a TetrahedronMesh<'a>, field: Field<'a>) -> Self {
        Self { mesh, field, faces: Cow::Owned(FaceCoefficients::default()) }
    }

    /// The interpolant that also satisfies a PDE, as well as one cubic a tetrahedron can
    /// without cracks.
    ///
    /// It starts at [`Tricubic::new`], so what the PDE does not determine comes from the
    /// neighbours. It reproduces any cubic that solves the PDE, if `g` does not depend on
    /// the solution, and is the same for any number of threads.
    pub fn with_pde(mesh: &'a TetrahedronMesh<'a>, field: Field<'a>, equation: &Equation) -> Self {
        let numbered = Faces::new(mesh);
        let without = completed(mesh, &field, &numbered);
        let start = |tetrahedron: usize| hermite(mesh, &field, tetrahedron, without[tetrahedron]);
        let tetrahedra: Vec<usize> = (0..mesh.tetrahedra().len()).collect();
        let equations: Vec<Option<FaceEquations>> = tetrahedra
            .par_chunks(CHUNK)
            .flat_map_iter(|chunk| face_equations(mesh, equation, chunk, start))
            .collect();
        let singular = equations.iter().filter(|equations| equations.is_none()).count();
        let equations = equations.into_iter().map(Option::unwrap_or_default).collect();
        let corrections = PerCell::All(least_squares(&numbered, equations));
        let coefficients = PerCell::All(corrected(without, &numbered, &corrections));
        let faces = FaceCoefficients { coefficients, singular };
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
    /// a face of such tetrahedra alone is as without a PDE.
    pub fn singular(&self) -> usize {
        self.faces.singular
    }
}

/// For each tetrahedron the coefficients amid its faces, from the neighbours.
fn completed(mesh: &TetrahedronMesh, field: &Field, faces: &Faces) -> Vec<[f64; 4]> {
    let estimate = |tetrahedron| estimate(mesh, field, faces, tetrahedron);
    let corrections = face_corrections(mesh, field, faces, |_| true, estimate);
    let tetrahedra = (0..mesh.tetrahedra().len()).into_par_iter();
    let start = tetrahedra.map(|tetrahedron| amid_faces(mesh, field, tetrahedron));
    corrected(start.collect(), faces, &corrections)
}

/// The same for some tetrahedra only; nothing if most of the mesh has a say in them.
fn completed_in_some(
    mesh: &TetrahedronMesh,
    field: &Field,
    tetrahedra: &Subset,
) -> Option<Vec<[f64; 4]>> {
    // Three rings of neighbours are among those that touch them: of four corners the first ring has
    // at least three at their points, and each ring at most one fewer than the one before.
    let nearby = tetrahedra.with_sharing(mesh, 1);
    let part = mesh.part(&nearby);
    let places = tetrahedra.simplices().filter_map(|tetrahedron| nearby.place(tetrahedron));
    let wanted = Subset::of_numbers(nearby.len(), places);
    let speaking = wanted.with_neighbours(&part);
    let around = speaking.with_neighbours(&part);
    if around.len() > mesh.tetrahedra().len() / 2 {
        return None;
    }
    let around = Surroundings::new(&part, around);
    let outermost = Outermost::new(&part, &speaking, &around);
    Some(completed_in(field, &wanted, &around, &outermost))
}

/// The same for some of those `around` them. These and their neighbours have a say in their faces, and
/// listen to their neighbours; some listen farther.
fn completed_in(
    field: &Field,
    tetrahedra: &Subset,
    around: &Surroundings,
    outermost: &Outermost,
) -> Vec<[f64; 4]> {
    let Surroundings { subset, part, faces } = around;
    let Outermost { around: far, places } = outermost;
    let estimate = |place: usize| match places.get(&(place as u32)) {
        Some(&place) => estimate(&far.part, field, &far.faces, place as usize),
        None => estimate(part, field, faces, place),
    };
    let is_wanted: Vec<bool> = subset.simplices().map(|n| tetrahedra.contains(n)).collect();
    let corrections = face_corrections(part, field, faces, |n| is_wanted[n], estimate);
    let wanted = (0..is_wanted.len()).filter(|&tetrahedron| is_wanted[tetrahedron]);
    let completed = wanted.map(|tetrahedron| {
        let mut coefficients = amid_faces(part, field, tetrahedron);
        correct(&mut coefficients, &faces.of_tetrahedra()[tetrahedron], &corrections);
        coefficients
    });
    completed.collect()
}

/// Some tetrahedra of a mesh, and their faces.
struct Surroundings<'a> {
    subset: Subset,
    /// These alone.
    part: TetrahedronMesh<'a>,
    /// Their faces.
    faces: Faces,
}

impl<'a> Surroundings<'a> {
    fn new(mesh: &'a TetrahedronMesh, subset: Subset) -> Self {
        let part = mesh.part(&subset);
        let faces = Faces::new(&part);
        Self { subset, part, faces }
    }
}

/// Tetrahedra that listen farther than others do: those on the boundary, which are few.
struct Outermost<'a> {
    /// All that they listen to.
    around: Surroundings<'a>,
    /// Their places there, by those in the surroundings of the others.
    places: FxHashMap<u32, u32>,
}

impl<'a> Outermost<'a> {
    /// Those that are `speaking` and listen farther than `around` them.
    fn new(mesh: &'a TetrahedronMesh, speaking: &Subset, around: &Surroundings) -> Self {
        let Surroundings { subset, part, faces } = around;
        let is_outermost = |(place, number): &(usize, usize)| {
            speaking.contains(*number) && asks_further(part, faces, *place)
        };
        let outermost: Vec<_> = subset.simplices().enumerate().filter(is_outermost).collect();
        let numbers = outermost.iter().map(|&(_, number)| number);
        let far = Subset::of_numbers(mesh.tetrahedra().len(), numbers);
        let far = Surroundings::new(mesh, far.with_neighbours(mesh).with_neighbours(mesh));
        let places = outermost.iter().filter_map(|&(place, number)| {
            far.subset.place(number).map(|there| (place as u32, there as u32))
        });
        Self { places: places.collect(), around: far }
    }
}

/// The coefficients amid the faces of a tetrahedron that reproduce quadratics.
fn amid_faces(mesh: &TetrahedronMesh, field: &Field, tetrahedron: usize) -> [f64; 4] {
    let start = quadratic_precision(mesh, field, tetrahedron);
    TetrahedronCubic::FACES.map(|position| start.coefficients[position])
}

/// For each tetrahedron the coefficients amid its faces, with what is to be added to that of each
/// face.
fn corrected(
    mut coefficients: Vec<[f64; 4]>,
    faces: &Faces,
    corrections: &PerCell<f64>,
) -> Vec<[f64; 4]> {
    let numbered = coefficients.par_iter_mut().zip(faces.of_tetrahedra());
    numbered.for_each(|(coefficients, faces)| correct(coefficients, faces, corrections));
    coefficients
}

/// Adds to the coefficients amid a tetrahedron's faces what is to be added to each.
fn correct(coefficients: &mut [f64; 4], faces: &[u32; 4], corrections: &PerCell<f64>) {
    for (coefficient, face) in coefficients.iter_mut().zip(faces) {
        *coefficient += corrections.get(*face as usize).copied().unwrap_or_default();
    }
}

impl TetrahedronCubics for Tricubic<'_> {
    fn mesh(&self) -> &TetrahedronMesh<'_> {
        self.mesh
    }

    fn cubic(&self, tetrahedron: usize) -> TetrahedronCubic {
        match self.faces.coefficients.get(tetrahedron) {
            Some(faces) => hermite(self.mesh, &self.field, tetrahedron, *faces),
            None => quadratic_precision(self.mesh, &self.field, tetrahedron),
        }
    }

    fn vertices(&self, tetrahedron: usize) -> [f64; 4] {
        self.mesh.simplices()[tetrahedron].map(|point| self.field.values[point as usize])
    }

    fn edge(&self, tetrahedron: usize, edge: [usize; 2]) -> SegmentCubic {
        let points = self.mesh.tetrahedra()[tetrahedron];
        hermite_on_edge(edge.map(|corner| points[corner]), self.mesh.points(), &self.field)
    }
}
