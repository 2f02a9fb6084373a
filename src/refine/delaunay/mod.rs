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
mod linked;
mod origins;
mod outside;
mod plane;
mod quality;
mod ties;
mod triangulation;

pub use error::DelaunayError;

use rayon::prelude::*;
use spade::Point2;

use self::choice::{Addition, by_thesis, without_conflicts};
use self::curve::Curve;
use self::features::{Feature, refuse_touching};
use self::linked::orientation;
use self::origins::Origins;
use self::plane::Plane;
use self::quality::improvements;
use self::triangulation::{Face, Triangulation, centroid, refuse_duplicates};
use super::{Marks, NewPoint, Refinement};
use crate::interruption::checkpoint;
use crate::mesh::{TriangleMesh, Vector};

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

/// After so many rounds of points for the sake of symmetry no more are added. A round or two are
/// enough for most meshes.
const TIE_ROUNDS: usize = 8;

/// A refinement in progress. Points are those of the mesh that a cell uses, then some around the
/// domain, then the new ones.
struct Job<'a> {
    mesh: &'a TriangleMesh<'a>,
    plane: Plane,
    triangulation: Triangulation,
    /// The mesh's number of each point that a cell uses.
    used: Vec<u32>,
    /// The triangulation's number of the first new point.
    first_new: u32,
    /// The feature that each new point halved; nothing for points inside.
    halved: Vec<Option<Feature>>,
    /// A number for each cell of the mesh, or none.
    regions: &'a [u32],
}

impl<'a> Job<'a> {
    fn new(
        mesh: &'a TriangleMesh<'a>,
        options: &DelaunayOptions<'a>,
    ) -> Result<Self, DelaunayError> {
        let plane = Plane::new(mesh)?;
        let (used, numbers) = used_points(mesh);
        let points: Vec<_> =
            used.iter().map(|&point| plane.project(&mesh.points()[point as usize])).collect();
        refuse_duplicates(&points).map_err(|error| error.renumbered(&used))?;
        let cells = counter_clockwise(mesh, &numbers, &points)?;
        let regions = (0..cells.len()).map(|cell| options.regions.get(cell).copied().unwrap_or(0));
        let cells = cells.into_iter().zip(regions);
        let curves = options
            .curves
            .iter()
            .map(|curve| Curve::new(curve.iter().map(|point| plane.project(point)).collect()));
        let triangulation = Triangulation::new(points, cells, &used, curves.collect())
            .map_err(|error| error.renumbered(&used))?;
        // last: cells that do not fit together mostly touch, too
        refuse_touching(&triangulation.features)?;
        let (regions, first_new) = (options.regions, triangulation.count() as u32);
        Ok(Self { mesh, plane, triangulation, used, first_new, halved: Vec::new(), regions })
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
            room -= self.look_after_angles(room, least_angle);
        }
        for _ in 0..TIE_ROUNDS {
            let places = self.triangulation.settle_ties(self.first_new).into_iter();
            let additions =
                places.map(|(place, face)| Addition::Inside { place, face, radius: 0.0 });
            let added = self.add(&additions.collect::<Vec<_>>(), room);
            if added == 0 {
                return;
            }
            room -= added;
            room -= self.look_after_angles(room, least_angle);
        }
        self.triangulation.settle_ties(self.first_new);
    }

    /// Adds what angles ask for, `room` points at most; returns how many.
    fn look_after_angles(&mut self, room: usize, least_angle: f64) -> usize {
        let mut all = 0;
        for _ in 0..quality::ROUNDS {
            if least_angle <= 0.0 || all == room {
                break;
            }
            let additions = improvements(&self.triangulation, self.first_new, least_angle);
            let added = self.add(&additions, room - all);
            if added == 0 {
                break;
            }
            all += added;
        }
        all
    }

    /// What is added for marked cells: nothing for one that an earlier portion has refined.
    fn for_marks(&self, marks: &[u32]) -> Vec<Addition> {
        let additions = marks.par_iter().flat_map_iter(|&cell| {
            checkpoint();
            let corners = self.mesh.corners(cell as usize).map(|c| self.plane.project(&c));
            let face = self.triangulation.locate(centroid(&corners), cell);
            let is_old = |face: &Face| face.points.iter().all(|&point| point < self.first_new);
            let face = face.filter(is_old);
            face.map_or_else(Vec::new, |face| by_thesis(&self.triangulation, &face))
        });
        without_conflicts(additions.collect())
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
                Addition::Inside { place, face, .. } => {
                    (self.triangulation.insert(place, face), None)
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
        let position = |point: u32| self.triangulation.position(point);
        let first_new = self.first_new;
        let faces: Vec<(Face, u32)> = self.triangulation.faces().flatten().collect();
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
        let origins = Origins::new(self.mesh, self.regions);
        let cells = faces.par_iter().map(|(face, region)| {
            origins.of_cell(face.points.map(number), *region, &points, face.number)
        });
        let (cells, parents): (Vec<[u32; 3]>, Vec<u32>) = cells.unzip();
        let around = parents_around(&cells, &parents, old, self.halved.len());
        let new_points = points[old as usize..].par_iter().zip(&self.halved).zip(&around);
        let new_points = new_points.map(|((point, halved), around)| match halved {
            Some(feature) => NewPoint::Edge { ends: feature.edge, at: feature.middle() },
            None => origins.of_point(point, around),
        });
        let new_points = new_points.collect();
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

/// Where the cells around each new point come from: a few of them.
fn parents_around(
    cells: &[[u32; 3]],
    parents: &[u32],
    first_new: u32,
    count: usize,
) -> Vec<arrayvec::ArrayVec<u32, 8>> {
    let mut around = vec![arrayvec::ArrayVec::new(); count];
    for (corners, &parent) in cells.iter().zip(parents) {
        for point in corners.iter().filter_map(|corner| corner.checked_sub(first_new)) {
            // more would only be looked at in vain
            let _ = around[point as usize].try_push(parent);
        }
    }
    around
}

/// The cells in numbers of points that are used, each counter-clockwise.
///
/// # Errors
/// If one has no area.
fn counter_clockwise(
    mesh: &TriangleMesh,
    numbers: &[u32],
    points: &[Point2<f64>],
) -> Result<Vec<[u32; 3]>, DelaunayError> {
    let cells = mesh.triangles().par_iter().enumerate().map(|(cell, corners)| {
        let [a, b, c] = corners.map(|point| numbers[point as usize]);
        let [p, q, r] = [a, b, c].map(|point| points[point as usize]);
        match orientation(p, q, r) {
            area if area > 0.0 => Ok([a, b, c]),
            area if area < 0.0 => Ok([a, c, b]),
            _ => Err(DelaunayError::NoArea { cell: cell as u32 }),
        }
    });
    // the first error in the order of the cells
    cells.collect::<Vec<_>>().into_iter().collect()
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

/// The longest edge of a face: its length, and its ends.
fn longest_edge(face: &Face) -> (f64, [u32; 2]) {
    let edges = [[0, 1], [1, 2], [2, 0]].map(|[i, j]| {
        let length = face.corners[i].distance_2(face.corners[j]).sqrt();
        (length, features::sorted([face.points[i], face.points[j]]))
    });
    edges.into_iter().fold((0.0, [0, 0]), |most, edge| if edge.0 > most.0 { edge } else { most })
}
