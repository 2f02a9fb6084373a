//! Quads that are rectangles, each with one bicubic instead of two triangles' polynomials.

use super::error::FilterError;
use super::family_member::{FamilyMember, HasFamily, MemberPieces};
use super::solution::Domain;
use crate::field::Field;
use crate::interpolant::family::{Dei, DeiOptions, Shape, spaces};
use crate::interpolant::{Equation, Pieces, Taylor};
use crate::mesh::{SimplexMesh, TriangleMesh, Vector};
use crate::vtk::UnstructuredGrid;

/// Two-dimensional cells, those that are rectangles as such.
pub struct Rectangles {
    /// The corners of each in turn.
    rectangles: SimplexMesh<'static, 4>,
    /// The triangles that are not parts of rectangles.
    triangles: TriangleMesh<'static>,
    /// Where each of the domain's triangles went.
    whereabouts: Vec<Whereabouts>,
}

/// Where a triangle went.
#[derive(Clone, Copy, Debug)]
enum Whereabouts {
    Rectangle(u32),
    Triangle(u32),
}

/// VTK's cell types: the corners of a quad are in turn, those of a pixel in rows.
const PIXEL: u8 = 8;
const QUAD: u8 = 9;

impl Rectangles {
    /// The cells of a grid that are rectangles; nothing if none is.
    ///
    /// # Errors
    /// If there are more than 32 bits can count.
    pub fn new(grid: &UnstructuredGrid, domain: &Domain<3>) -> Result<Option<Self>, FilterError> {
        let mesh = &domain.mesh;
        let (mut rectangles, mut triangles) = (Vec::new(), Vec::new());
        let mut whereabouts = Vec::with_capacity(domain.count());
        // simplices of one cell follow one another
        let mut last = None;
        for (simplex, corners) in mesh.triangles().iter().enumerate() {
            let cell = domain.parent(simplex as u32);
            if last.is_none_or(|(known, _)| known != cell) {
                let rectangle = rectangle(grid, mesh, cell as usize);
                rectangles.extend(rectangle);
                last = Some((cell, rectangle.is_some()));
            }
            whereabouts.push(if last.is_some_and(|(_, is_rectangle)| is_rectangle) {
                Whereabouts::Rectangle(rectangles.len() as u32 - 1)
            } else {
                triangles.push(*corners);
                Whereabouts::Triangle(triangles.len() as u32 - 1)
            });
        }
        if rectangles.is_empty() {
            return Ok(None);
        }
        let rectangles = SimplexMesh::new(mesh.points().to_vec(), rectangles)?;
        let triangles = SimplexMesh::new(mesh.points().to_vec(), triangles)?;
        Ok(Some(Self { rectangles, triangles, whereabouts }))
    }
}

/// The corners of a cell in turn, if it is a rectangle.
fn rectangle(grid: &UnstructuredGrid, mesh: &TriangleMesh, cell: usize) -> Option<[u32; 4]> {
    let corners: [i64; 4] = grid.cells.get(cell)?.try_into().ok()?;
    let [a, b, c, d] = corners.map(|corner| corner as u32);
    let in_turn = match grid.types[cell] {
        QUAD => [a, b, c, d],
        PIXEL => [a, b, d, c],
        _ => return None,
    };
    let places = in_turn.map(|corner| mesh.points()[corner as usize]);
    Shape::Rectangle.is_shape_of(&places).then_some(in_turn)
}

/// The standard DEI on rectangles, and on the triangles that are not parts of them.
struct Bicubics<'a> {
    mesh: &'a TriangleMesh<'a>,
    cells: &'a Rectangles,
    on_rectangles: Dei<'a, 4, 16>,
    on_triangles: Box<dyn Pieces<3> + 'a>,
}

impl Rectangles {
    /// The standard DEI: as of the triangles `mesh`, those of rectangles together.
    ///
    /// # Errors
    /// None: it is a member on two-dimensional cells.
    pub fn dei<'a>(
        &'a self,
        mesh: &'a TriangleMesh<'a>,
        field: Field<'a>,
        equation: &Equation,
    ) -> Result<MemberPieces<'a, 3>, FilterError> {
        let options = DeiOptions::default();
        let on_rectangles =
            Dei::new(spaces::RECTANGLE, &self.rectangles, field, equation, &options);
        let others = self.triangles.member(FamilyMember::Dei, field, equation)?;
        let singular = on_rectangles.singular() + others.singular;
        let pieces = Bicubics { mesh, cells: self, on_rectangles, on_triangles: others.pieces };
        Ok(MemberPieces { pieces: Box::new(pieces), singular })
    }

    /// The bilinear weights of a rectangle's corners at a point of it.
    fn weights(&self, rectangle: usize, point: &Vector) -> [f64; 4] {
        let [a, b, _, d] = self.rectangles.corners(rectangle);
        let along = |side: Vector| (point - a).dot(&side) / side.norm_squared();
        let (s, t) = (along(b - a), along(d - a));
        [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t]
    }
}

impl Pieces<3> for Bicubics<'_> {
    fn mesh(&self) -> &TriangleMesh<'_> {
        self.mesh
    }

    fn taylor(&self, cell: usize, at: &[f64; 3]) -> Taylor {
        match self.cells.whereabouts[cell] {
            Whereabouts::Triangle(triangle) => self.on_triangles.taylor(triangle as usize, at),
            Whereabouts::Rectangle(rectangle) => {
                let rectangle = rectangle as usize;
                let weights = self.cells.weights(rectangle, &self.mesh.position(cell, at));
                self.on_rectangles.taylor(rectangle, &weights)
            }
        }
    }
}
