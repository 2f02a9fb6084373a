//! One cell after another, cut into triangles or tetrahedra.

use super::convex_solid::{ConvexSolid, Key};
use super::corner_cut::CornerCut;
use super::layout::{Cut, Layout};
use super::left_out::Reason;
use super::orientation::{Lie, orient};
use super::polygon::PolygonCutter;
use super::polyhedron::PolyhedronFaces;
use crate::mesh::Vector;
use crate::vtk::UnstructuredGrid;

/// Cuts the cells of a grid. What it needs of memory is used again for each.
pub struct Splitter<'a> {
    grid: &'a UnstructuredGrid,
    positions: &'a [Vector],
    polygon: PolygonCutter,
    solid: ConvexSolid,
    corner_cut: CornerCut,
    polyhedron: PolyhedronFaces,
}

impl<'a> Splitter<'a> {
    /// For a grid, and its points as vectors.
    pub fn new(grid: &'a UnstructuredGrid, positions: &'a [Vector]) -> Self {
        Self {
            grid,
            positions,
            polygon: PolygonCutter::default(),
            solid: ConvexSolid::default(),
            corner_cut: CornerCut::default(),
            polyhedron: PolyhedronFaces::default(),
        }
    }

    /// Adds the simplices of a cell with the given points.
    ///
    /// # Errors
    /// Why it cannot be cut; then nothing is added.
    pub fn cut(
        &mut self,
        cell: usize,
        points: &[i64],
        triangles: &mut Vec<[u32; 3]>,
        tetrahedra: &mut Vec<[u32; 4]>,
    ) -> Result<Lie, Reason> {
        let layout = Layout::new(self.grid.types[cell], points.len())?;
        let (flat, solid) = (triangles.len(), tetrahedra.len());
        let result = match layout.cut {
            Cut::Nothing => return Ok(Lie::Apart),
            Cut::Solids(_) | Cut::Corners(_) | Cut::Polyhedron => {
                self.solid(cell, &layout, points, tetrahedra)
            }
            cut => self.flat(cut, points, triangles),
        };
        let result = result.and_then(|()| {
            if triangles.len() == flat && tetrahedra.len() == solid {
                return Err(Reason::Collapsed);
            }
            let is_polyhedron = matches!(layout.cut, Cut::Polyhedron);
            orient(&mut tetrahedra[solid..], self.positions, is_polyhedron)
        });
        result.inspect_err(|_| {
            triangles.truncate(flat);
            tetrahedra.truncate(solid);
        })
    }

    fn flat(
        &mut self,
        cut: Cut,
        points: &[i64],
        triangles: &mut Vec<[u32; 3]>,
    ) -> Result<(), Reason> {
        match cut {
            Cut::Polygons(polygons) => self.polygons(polygons, points, triangles),
            Cut::Strip => {
                strip(points, triangles);
                Ok(())
            }
            Cut::QuadraticPolygon => {
                let (corners, mids) = points.split_at(points.len() / 2);
                let around = corners.iter().zip(mids).flat_map(|(&c, &m)| [c as u32, m as u32]);
                self.polygon.cut(around, self.positions, triangles)
            }
            _ => {
                let corners = points.iter().map(|&point| point as u32);
                self.polygon.cut(corners, self.positions, triangles)
            }
        }
    }

    /// The polygons of a two-dimensional cell; those that have collapsed are left
    /// out.
    fn polygons(
        &mut self,
        polygons: &[&[u8]],
        points: &[i64],
        triangles: &mut Vec<[u32; 3]>,
    ) -> Result<(), Reason> {
        for polygon in polygons {
            let corners = polygon.iter().map(|&node| points[usize::from(node)] as u32);
            match self.polygon.cut(corners, self.positions, triangles) {
                Ok(()) | Err(Reason::Collapsed) => {}
                Err(reason) => return Err(reason),
            }
        }
        Ok(())
    }

    fn solid(
        &mut self,
        cell: usize,
        layout: &Layout,
        points: &[i64],
        tetrahedra: &mut Vec<[u32; 4]>,
    ) -> Result<(), Reason> {
        let key = |&node: &u8| {
            let node = usize::from(node);
            Key::new(layout.rank(node), points[node] as u32)
        };
        match layout.cut {
            // a tetrahedron keeps its corners' order: marks of refinement go by it
            Cut::Solids(_) if is_tetrahedron(points) => {
                tetrahedra.push(std::array::from_fn(|corner| points[corner] as u32));
            }
            Cut::Solids(solids) => {
                for faces in solids {
                    self.solid.clear();
                    faces.iter().for_each(|face| self.solid.push_face(face.iter().map(key)));
                    self.solid.cut(tetrahedra);
                }
            }
            Cut::Corners(faces) => {
                self.corner_cut.clear();
                faces.iter().for_each(|face| self.corner_cut.push_face(face.iter().map(key)));
                if !self.corner_cut.cut(tetrahedra) {
                    return Err(Reason::Collapsed);
                }
            }
            Cut::Polyhedron => {
                self.solid.clear();
                self.polyhedron.push(self.grid.polyhedra.as_ref(), cell, &mut self.solid)?;
                self.solid.cut(tetrahedra);
            }
            // the others are no solids
            _ => {}
        }
        Ok(())
    }
}

/// Whether a solid of these points is a tetrahedron that has not collapsed.
pub fn is_tetrahedron(points: &[i64]) -> bool {
    points.len() == 4 && (1..4).all(|n| !points[..n].contains(&points[n]))
}

/// The triangles of a strip; those that only join two strips are none.
fn strip(points: &[i64], triangles: &mut Vec<[u32; 3]>) {
    for (place, corners) in points.windows(3).enumerate() {
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(|point| point as u32);
        if a != b && b != c && c != a {
            // every second triangle of a strip is turned around
            triangles.push(if place % 2 == 0 { [a, b, c] } else { [b, a, c] });
        }
    }
}
