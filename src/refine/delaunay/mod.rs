//! The thesis' hybrid: new points in a Delaunay triangulation (section 3.4).
//!
//! For every marked triangle the most appropriate point is added (`choice`): its
//! circumcenter, if that lies inside the domain; the middle of its longest edge, if that is on the
//! boundary; its own middle otherwise. The triangulation stays Delaunay, but for the edges that
//! are kept (`features`): those of the boundary and those between regions.
//!
//! All points of a step are chosen before the first is added, and what they become does not
//! depend on their order: so symmetric meshes stay symmetric. Then angles are looked after
//! (`quality`): triangles with a new point and too small an angle get points by Ruppert's rule
//! (1995).
//!
//! Cells that were Delaunay and are not marked, nor near what is, stay as they are.

mod choice;
mod curve;
mod error;
mod features;
mod plane;
mod quality;
mod ties;
mod triangulation;

pub use error::DelaunayError;

use std::collections::HashMap;

use rayon::prelude::*;

use self::choice::{Addition, by_thesis, without_conflicts};
use self::curve::Curve;
use self::features::{Feature, edges_and_features, refuse_touching};
use self::plane::Plane;
use self::quality::improvements;
use self::ties::Ties;
use self::triangulation::{Face, Triangulation, centroid, refuse_duplicates};
use super::{Marks, NewPoint, Refinement};
use crate::interruption::checkpoint;
use crate::mesh::{PointLocator, TriangleMesh, Vector};

/// What the triangulation keeps, and how well.
#[derive(Clone, Copy, Debug)]
pub struct DelaunayOptions<'a> {
    /// A number for each cell; edges between cells of different numbers are kept. Empty: all
    /// cells are of one region.
    pub regions: &'a [u32],
    /// Curved boundaries, in the mesh's plane: a kept edge with both ends on one of these (to
    /// a hundredth of its length) gets its new point there, halfway along the polyline,
    /// unless other points are in the way. Closed if it ends where it begins.
    pub curves: &'a [Vec<Vector>],
    /// In degrees: triangles with a new point and a smaller angle are refined too, as far as
    /// the number of points allows it, unless two kept edges make the angle. Ruppert's
    /// proof holds up to 20.7; 0 leaves them as they are.
    pub least_angle: f64,
}

impl Default for DelaunayOptions<'_> {
    fn default() -> Self {
        Self { regions: &[], curves: &[], least_angle: 20.0 }
    }
}

/// Refines the marked triangles of a flat mesh. Needs no state.
///
/// The bound on the number of points is met exactly if the marks and the angles ask for as
/// many. It is spent in portions, each followed by what its angles ask for, so that the mesh is
/// good wherever it ends: only the last few triangles may have smaller angles.
///
/// # Errors
/// See [`DelaunayError`]: marks or regions of another mesh, a mesh that is not flat, points at
/// the same place, edges that cross, a boundary that touches itself, curves of another mesh.
pub fn delaunay(
    mesh: &TriangleMesh,
    marks: &Marks,
    options: &DelaunayOptions,
) -> Result<Refinement<3>, DelaunayError> {
    Marks { state: &[], ..*marks }.check(mesh)?;
    let (regions, cells) = (options.regions.len(), mesh.triangles().len());
    if regions != 0 && regions != cells {
        return Err(DelaunayError::Regions { regions, cells });
    }
    if marks.cells.is_empty() {
        return Ok(unchanged(mesh));
    }
    let mut job = Job::new(mesh, options)?;
    job.refine(marks.cells, marks.room(mesh.points().len()), options.least_angle);
    Ok(job.finish())
}

/// The mesh as it is.
fn unchanged(mesh: &TriangleMesh) -> Refinement<3> {
    Refinement {
        points: mesh.points().to_vec(),
        cells: mesh.triangles().to_vec(),
        parents: (0..mesh.triangles().len() as u32).collect(),
        ..Refinement::default()
    }
}

/// A refinement in progress. Points are those of the mesh that a cell uses, then the new ones.
struct Job<'a> {
    mesh: &'a TriangleMesh<'a>,
    plane: Plane,
    triangulation: Triangulation,
    /// The mesh's number of each point that a cell uses.
    used: Vec<u32>,
    /// The triangulation's number of each of the mesh's points.
    numbers: Vec<u32>,
    /// The feature that each new point halved; nothing for points inside.
    halved: Vec<Option<Feature>>,
}

impl<'a> Job<'a> {
    fn new(mesh: &'a TriangleMesh<'a>, options: &DelaunayOptions) -> Result<Self, DelaunayError> {
        let plane = Plane::new(mesh)?;
        let (used, numbers) = used_points(mesh);
        let points: Vec<_> =
            used.iter().map(|&point| plane.project(&mesh.points()[point as usize])).collect();
        refuse_duplicates(&points).map_err(|error| error.renumbered(&used))?;
        let (edges, features) = edges_and_features(mesh, options.regions, |cell| {
            let corners = mesh.corners(cell).map(|corner| plane.project(&corner));
            triangulation::cross(corners[0], corners[1], corners[2]) < 0.0
        })?;
        // used points are numbered in their order: the lower end stays the lower one
        let number = |point: u32| numbers[point as usize];
        let edges = edges.into_iter().map(|edge| edge.map(|p| number(p as u32) as usize));
        let features = features.into_iter().map(|(ends, kept)| (ends.map(number), kept)).collect();
        let curves = options
            .curves
            .iter()
            .map(|curve| Curve::new(curve.iter().map(|point| plane.project(point)).collect()));
        let edges: Vec<_> = edges.collect();
        let triangulation = Triangulation::new(points, &edges, features, curves.collect())
            .map_err(|error| error.renumbered(&used))?;
        // last: cells that do not fit together mostly touch, too
        refuse_touching(&triangulation.features)?;
        Ok(Self { mesh, plane, triangulation, used, numbers, halved: Vec::new() })
    }

    /// Adds the points that marks and angles ask for, `room` of them at most.
    fn refine(&mut self, marks: &[u32], mut room: usize, least_angle: f64) {
        let mut open = marks;
        while !open.is_empty() && room > 0 {
            // half of what is left, so that the other half can look after the angles
            let portion = if open.len() <= room { open.len() } else { room.div_ceil(2) };
            let (now, later) = open.split_at(portion);
            open = later;
            let additions = self.for_marks(now);
            room -= self.add(&additions, room);
            let mut rounds = quality::ROUNDS;
            while least_angle > 0.0 && room > 0 && rounds > 0 {
                let first_new = self.used.len() as u32;
                let additions = improvements(&self.triangulation, first_new, least_angle);
                let added = self.add(&additions, room);
                if added == 0 {
                    break;
                }
                room -= added;
                rounds -= 1;
            }
        }
    }

    /// What is added for marked cells: nothing for one that an earlier portion has refined.
    fn for_marks(&self, marks: &[u32]) -> Vec<Addition> {
        let first_new = self.used.len() as u32;
        let additions = marks.iter().filter_map(|&cell| {
            checkpoint();
            let corners = self.mesh.corners(cell as usize).map(|c| self.plane.project(&c));
            let near = self.numbers[self.mesh.triangles()[cell as usize][0] as usize];
            let face = self.triangulation.locate(centroid(&corners), near)?;
            let is_old = face.points.iter().all(|&point| point < first_new);
            is_old.then(|| by_thesis(&self.triangulation, &face))
        });
        without_conflicts(&self.triangulation, additions.flatten().collect())
    }

    /// Adds points, `room` of them at most; returns how many.
    fn add(&mut self, additions: &[Addition], room: usize) -> usize {
        let mut added = 0;
        for addition in additions {
            checkpoint();
            if added == room {
                break;
            }
            let (point, feature) = match *addition {
                Addition::Halve { edge, halvings } => {
                    let feature = self.triangulation.features.get(&edge).copied();
                    (self.triangulation.halve(edge, halvings), feature)
                }
                Addition::Inside { place, near, .. } => {
                    (self.triangulation.insert(place, near), None)
                }
            };
            if point.is_some() {
                self.halved.push(feature);
                added += 1;
            }
        }
        added
    }

    /// The refined mesh.
    fn finish(self) -> Refinement<3> {
        let faces = self.triangulation.faces();
        let position = |point: u32| self.triangulation.position(point);
        let first_new = self.used.len() as u32;
        let is_kept = |edge| self.triangulation.features.contains_key(&edge);
        let mut triangles: Vec<[u32; 3]> = faces.iter().map(|(face, _)| face.points).collect();
        Ties { position: &position, first_new, is_kept: &is_kept }.settle(&mut triangles);
        let old = self.mesh.points().len() as u32;
        let number = |point: u32| match self.used.get(point as usize) {
            Some(&number) => number,
            None => old + point - first_new,
        };
        let mut points = self.mesh.points().to_vec();
        points.extend((0..self.halved.len() as u32).map(|new| {
            let there = self.plane.lift(position(first_new + new));
            match self.halved[new as usize] {
                // on the straight edge exactly, or where the curve has it
                Some(feature) => self.on_edge(&feature, there),
                None => there,
            }
        }));
        triangles.par_iter_mut().for_each(|cell| *cell = cell.map(number));
        let origins = Origins::new(self.mesh);
        let cells: Vec<([u32; 3], u32)> =
            triangles.par_iter().map(|&cell| origins.of_cell(cell, &points)).collect();
        let new_points = points[old as usize..].par_iter().zip(&self.halved);
        let new_points = new_points.map(|(point, halved)| match halved {
            Some(feature) => NewPoint::Edge { ends: feature.edge, at: feature.middle() },
            None => origins.of_point(point),
        });
        let new_points = new_points.collect();
        let (cells, parents) = cells.into_iter().unzip();
        Refinement { points, cells, parents, new_points, ..Refinement::default() }
    }

    /// The middle of a feature, in space: that of the straight edge unless a curve moved it.
    fn on_edge(&self, feature: &Feature, there: Vector) -> Vector {
        let [from, to] = feature.edge.map(|end| self.mesh.points()[end as usize]);
        let straight = from + (to - from) * feature.middle();
        let is_straight = (straight - there).norm() <= 1e-12 * (to - from).norm();
        if is_straight { straight } else { there }
    }
}

/// The points that cells use, in their order; and for each point its place among them.
fn used_points(mesh: &TriangleMesh) -> (Vec<u32>, Vec<u32>) {
    let mut numbers = vec![u32::MAX; mesh.points().len()];
    mesh.triangles().iter().flatten().for_each(|&point| numbers[point as usize] = 0);
    let mut used = Vec::with_capacity(numbers.len());
    for (point, number) in numbers.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
        *number = used.len() as u32;
        used.push(point as u32);
    }
    (used, numbers)
}

/// Finds where cells and points come from.
struct Origins<'a> {
    mesh: &'a TriangleMesh<'a>,
    locator: PointLocator,
    /// The cells by their points, ascending.
    cells: HashMap<[u32; 3], u32>,
}

impl<'a> Origins<'a> {
    fn new(mesh: &'a TriangleMesh<'a>) -> Self {
        let named =
            mesh.triangles().iter().zip(0..).map(|(&cell, number)| (ascending(cell), number));
        Self { mesh, locator: PointLocator::new(mesh), cells: named.collect() }
    }

    /// A cell turned as the one it lies in, which is told too. A cell of the input is as it was.
    fn of_cell(&self, cell: [u32; 3], points: &[Vector]) -> ([u32; 3], u32) {
        if let Some(&parent) = self.cells.get(&ascending(cell)) {
            return (self.mesh.triangles()[parent as usize], parent);
        }
        let [a, b, c] = cell.map(|point| points[point as usize]);
        let middle = (a + b + c) / 3.0;
        let found = self.locator.locate(self.mesh, &middle, f64::INFINITY);
        let parent = found.map_or(0, |found| found.simplex);
        let normal = (b - a).cross(&(c - a));
        let is_turned = normal.dot(self.mesh.frame(parent).normal()) < 0.0;
        (if is_turned { [cell[0], cell[2], cell[1]] } else { cell }, parent as u32)
    }

    fn of_point(&self, point: &Vector) -> NewPoint<3> {
        match self.locator.locate(self.mesh, point, f64::INFINITY) {
            Some(found) => NewPoint::Inside { cell: found.simplex as u32, at: found.at },
            None => NewPoint::Inside { cell: 0, at: [1.0 / 3.0; 3] },
        }
    }
}

fn ascending(mut cell: [u32; 3]) -> [u32; 3] {
    cell.sort_unstable();
    cell
}

/// The longest edge of a face: its length, and its ends.
fn longest_edge(face: &Face) -> (f64, [u32; 2]) {
    let edges = [[0, 1], [1, 2], [2, 0]].map(|[i, j]| {
        let length = face.corners[i].distance_2(face.corners[j]).sqrt();
        (length, features::sorted([face.points[i], face.points[j]]))
    });
    edges.into_iter().fold((0.0, [0, 0]), |most, edge| if edge.0 > most.0 { edge } else { most })
}
