//! The faces of a polyhedron, made to run counter-clockwise from outside.

use super::convex_solid::{ConvexSolid, Key};
use super::left_out::Reason;
use crate::vtk::{CellArray, Polyhedra};

/// An edge of a face: its points in ascending order, the face, and whether the face
/// runs against that order.
type Edge = (u32, u32, u32, bool);

/// Room to look at the faces of a polyhedron. Files do not say which side of a face
/// is outside; all that counts here is that they say the same of all.
#[derive(Debug, Default)]
pub struct PolyhedronFaces {
    edges: Vec<Edge>,
    /// For each edge of a face, the face beyond it and whether that runs the other
    /// way round; in order of the faces.
    links: Vec<(u32, u32, bool)>,
    /// For each face, whether it is to be turned; nothing if not yet known.
    turned: Vec<Option<bool>>,
    waiting: Vec<u32>,
}

impl PolyhedronFaces {
    /// Adds the faces of a cell to a solid, all counter-clockwise from one side.
    ///
    /// # Errors
    /// If they do not form one closed surface with an inside and an outside.
    pub fn push(
        &mut self,
        polyhedra: Option<&Polyhedra>,
        cell: usize,
        solid: &mut ConvexSolid,
    ) -> Result<(), Reason> {
        let polyhedra = polyhedra.ok_or(Reason::OpenSurface)?;
        let numbers = polyhedra.cells.get(cell).unwrap_or_default();
        self.orient(&polyhedra.faces, numbers)?;
        for (&number, turned) in numbers.iter().zip(&self.turned) {
            let keys =
                face(&polyhedra.faces, number).iter().map(|&point| Key::new(0, point as u32));
            if *turned == Some(true) {
                solid.push_face(keys.rev());
            } else {
                solid.push_face(keys);
            }
        }
        Ok(())
    }

    /// Finds which faces to turn.
    fn orient(&mut self, faces: &CellArray, numbers: &[i64]) -> Result<(), Reason> {
        self.edges.clear();
        for (place, &number) in numbers.iter().enumerate() {
            let points = face(faces, number);
            for (n, &from) in points.iter().enumerate() {
                let to = points[(n + 1) % points.len()];
                let (low, high) = (from.min(to) as u32, from.max(to) as u32);
                if low != high {
                    self.edges.push((low, high, place as u32, from > to));
                }
            }
        }
        self.link()?;
        self.turned.clear();
        self.turned.resize(numbers.len(), None);
        self.spread()
    }

    /// Joins faces at their common edges: each edge must have two.
    fn link(&mut self) -> Result<(), Reason> {
        self.edges.sort_unstable();
        self.links.clear();
        for pair in self.edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let &[(.., one, against), (.., other, other_against)] = pair else {
                return Err(Reason::OpenSurface);
            };
            // neighbours that agree run along their edge in opposite directions
            let turned = against == other_against;
            self.links.extend([(one, other, turned), (other, one, turned)]);
        }
        self.links.sort_unstable();
        Ok(())
    }

    /// Goes from face to face over their links.
    fn spread(&mut self) -> Result<(), Reason> {
        let Some(&(first, ..)) = self.links.first() else { return Err(Reason::OpenSurface) };
        self.turned[first as usize] = Some(false);
        self.waiting.clear();
        self.waiting.push(first);
        while let Some(face) = self.waiting.pop() {
            let own = self.turned[face as usize] == Some(true);
            let start = self.links.partition_point(|link| link.0 < face);
            for &(_, neighbour, differs) in
                self.links[start..].iter().take_while(|link| link.0 == face)
            {
                let wanted = own != differs;
                match self.turned[neighbour as usize] {
                    None => {
                        self.turned[neighbour as usize] = Some(wanted);
                        self.waiting.push(neighbour);
                    }
                    Some(turned) if turned != wanted => return Err(Reason::OpenSurface),
                    Some(_) => {}
                }
            }
        }
        // a face of no edges has none to be reached by, and no area either
        let reached = |link: &(u32, u32, bool)| self.turned[link.0 as usize].is_some();
        if self.links.iter().all(reached) { Ok(()) } else { Err(Reason::OpenSurface) }
    }
}

/// The points of a face.
fn face(faces: &CellArray, number: i64) -> &[i64] {
    // the reader has checked that every number is that of a face
    usize::try_from(number).ok().and_then(|number| faces.get(number)).unwrap_or_default()
}
