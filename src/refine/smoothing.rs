//! Points moved so that triangles have better shapes.
//!
//! Thesis, A.3. Sweep by sweep each point is offered other places, and takes one if the worst of
//! its triangles becomes better there: so no triangle turns over, and none becomes worse than
//! the worst beside it was.
//!
//! Points on the boundary, on edges between regions, and where a surface is curved stay.

use rayon::prelude::*;

use super::{MovedPoint, NewPoint, Refinement};
use crate::interruption::checkpoint;
use crate::mesh::{NumberedEdges, PointLocator, TriangleMesh, Vector};

/// Where points are offered a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Smoothing {
    /// The mean of the neighbours (A.3.1), or part of the way there.
    Laplacian,
    /// Where the worst of the triangles would be equilateral, or part of the way there, whatever
    /// is best (R. E. Bank's line search; A.3.2).
    Optimised,
}

/// Parts of the way that are tried.
const STEPS: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0625];

/// A gain below this is none: shapes are between 0 and 1.
const LEAST_GAIN: f64 = 1e-9;

/// Normals of a flat surface differ by less than this.
const FLAT: f64 = 1e-9;

/// Moves points of a refinement of `mesh`. `regions`: a number for each cell of `mesh`, or
/// nothing if there is one region.
pub fn smooth(
    mesh: &TriangleMesh,
    refined: &mut Refinement<3>,
    regions: &[u32],
    smoothing: Smoothing,
    sweeps: usize,
) {
    let Ok(view) = TriangleMesh::view(&refined.points, &refined.cells) else { return };
    let region = |cell: u32| regions.get(refined.parents[cell as usize] as usize);
    let stars = Stars::new(&view, |one, other| region(one) == region(other));
    let mut points = refined.points.clone();
    for _ in 0..sweeps {
        checkpoint();
        let mut moved = false;
        for star in stars.iter() {
            moved |= star.improve(&refined.cells, &mut points, smoothing);
        }
        if !moved {
            break;
        }
    }
    note_moves(mesh, refined, points);
}

/// Notes where in the input the points lie now.
fn note_moves(mesh: &TriangleMesh, refined: &mut Refinement<3>, points: Vec<Vector>) {
    let locator = PointLocator::new(mesh);
    let pairs = refined.points.par_iter().zip(&points).enumerate();
    let found = pairs.filter(|(_, (before, after))| before != after).filter_map(|(point, pair)| {
        let found = locator.locate(mesh, pair.1, f64::INFINITY)?;
        Some(MovedPoint { point: point as u32, cell: found.simplex as u32, at: found.at })
    });
    let first = mesh.points().len();
    for moved in found.collect::<Vec<MovedPoint<3>>>() {
        let MovedPoint { point, cell, at } = moved;
        match (point as usize).checked_sub(first) {
            Some(new) => refined.new_points[new] = NewPoint::Inside { cell, at },
            None => refined.moved.push(moved),
        }
    }
    refined.points = points;
}

/// The triangles around each point that may move.
struct Stars {
    points: Vec<(u32, Vector)>,
    /// Where the triangles of each begin, and the end of the last.
    offsets: Vec<u32>,
    triangles: Vec<u32>,
}

/// A point that may move, the normal there, and its triangles.
struct Star<'a> {
    point: u32,
    normal: Vector,
    triangles: &'a [u32],
}

impl Stars {
    /// `are_one`: whether two triangles are of one region.
    fn new(mesh: &TriangleMesh, are_one: impl Fn(u32, u32) -> bool) -> Self {
        let edges = NumberedEdges::new(mesh);
        let mut is_free = vec![true; mesh.points().len()];
        for (edge, ends) in edges.ends().iter().enumerate() {
            let inside = match edges.triangles(edge as u32) {
                &[one, other] => are_one(one, other),
                _ => false,
            };
            ends.iter().for_each(|&end| is_free[end as usize] &= inside);
        }
        let mut around: Vec<(u32, u32)> = Vec::new();
        for (triangle, corners) in mesh.triangles().iter().enumerate() {
            let free = corners.iter().filter(|&&corner| is_free[corner as usize]);
            around.extend(free.map(|&corner| (corner, triangle as u32)));
        }
        around.par_sort_unstable();
        let mut stars = Self { points: Vec::new(), offsets: vec![0], triangles: Vec::new() };
        for group in around.chunk_by(|one, next| one.0 == next.0) {
            let normal = |triangle: u32| *mesh.frame(triangle as usize).normal();
            let first = normal(group[0].1);
            let is_flat = group.iter().all(|&(_, t)| (normal(t) - first).norm() < FLAT);
            if is_flat && first != Vector::zeros() {
                stars.points.push((group[0].0, first));
                stars.triangles.extend(group.iter().map(|&(_, triangle)| triangle));
                stars.offsets.push(stars.triangles.len() as u32);
            }
        }
        stars
    }

    fn iter(&self) -> impl Iterator<Item = Star<'_>> {
        self.points.iter().zip(self.offsets.windows(2)).map(|(&(point, normal), bounds)| {
            let triangles = &self.triangles[bounds[0] as usize..bounds[1] as usize];
            Star { point, normal, triangles }
        })
    }
}

impl Star<'_> {
    /// Moves the point if that is better; returns whether it was.
    fn improve(&self, cells: &[[u32; 3]], points: &mut [Vector], smoothing: Smoothing) -> bool {
        let here = points[self.point as usize];
        let before = self.worst(cells, points, &here);
        let target = match smoothing {
            Smoothing::Laplacian => self.mean(cells, points),
            Smoothing::Optimised => self.equilateral(cells, points, before.1),
        };
        let places = STEPS.map(|step| here + (target - here) * step);
        let offers = places.map(|place| (self.worst(cells, points, &place).0, place));
        let is_gain = |offer: &&(f64, Vector)| offer.0 > before.0 + LEAST_GAIN;
        let taken = match smoothing {
            Smoothing::Laplacian => offers.iter().find(is_gain),
            Smoothing::Optimised => {
                offers.iter().filter(is_gain).max_by(|one, other| one.0.total_cmp(&other.0))
            }
        };
        if let Some((_, place)) = taken {
            points[self.point as usize] = *place;
        }
        taken.is_some()
    }

    /// The shape of the worst triangle if the point were elsewhere, and which it is.
    fn worst(&self, cells: &[[u32; 3]], points: &[Vector], place: &Vector) -> (f64, u32) {
        let shapes = self.triangles.iter().map(|&triangle| {
            let corner = |corner: u32| {
                if corner == self.point { *place } else { points[corner as usize] }
            };
            (shape(&cells[triangle as usize].map(corner), &self.normal), triangle)
        });
        shapes.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap_or((1.0, 0))
    }

    /// The mean of the neighbours: each is in two of the triangles.
    fn mean(&self, cells: &[[u32; 3]], points: &[Vector]) -> Vector {
        let corners = self.triangles.iter().flat_map(|&triangle| cells[triangle as usize]);
        let others = corners.filter(|&corner| corner != self.point);
        let sum: Vector = others.map(|corner| points[corner as usize]).sum();
        sum / (2 * self.triangles.len()) as f64
    }

    /// Where the point makes a triangle equilateral.
    fn equilateral(&self, cells: &[[u32; 3]], points: &[Vector], triangle: u32) -> Vector {
        let corners = cells[triangle as usize];
        let own = corners.iter().position(|&corner| corner == self.point).unwrap_or(0);
        let [a, b] = [1, 2].map(|step| points[corners[(own + step) % 3] as usize]);
        (a + b) * 0.5 + self.normal.cross(&(b - a)) * 0.75_f64.sqrt()
    }
}

/// Bank's `4 √3 A / (l₁² + l₂² + l₃²)`: 1 if equilateral, below 0 if turned over.
fn shape(corners: &[Vector; 3], normal: &Vector) -> f64 {
    let [a, b, c] = corners;
    let doubled = (b - a).cross(&(c - a)).dot(normal);
    let squares = (b - a).norm_squared() + (c - b).norm_squared() + (a - c).norm_squared();
    2.0 * 3.0_f64.sqrt() * doubled / squares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hexagon around a point that is not in its middle.
    fn wheel(middle: Vector) -> (TriangleMesh<'static>, Refinement<3>) {
        let rim = (0..6).map(|n| {
            let angle = f64::from(n) * std::f64::consts::FRAC_PI_3;
            Vector::new(angle.cos(), angle.sin(), 0.0)
        });
        let points: Vec<Vector> = [middle].into_iter().chain(rim).collect();
        let cells: Vec<[u32; 3]> = (0..6).map(|n| [0, 1 + n, 1 + (n + 1) % 6]).collect();
        let mesh = TriangleMesh::new(points.clone(), cells.clone()).unwrap();
        let parents = (0..6).collect();
        (mesh, Refinement { points, cells, parents, ..Refinement::default() })
    }

    #[test]
    fn the_middle_of_a_hexagon_is_found() {
        for (smoothing, near) in [(Smoothing::Laplacian, 1e-12), (Smoothing::Optimised, 0.05)] {
            let (mesh, mut refined) = wheel(Vector::new(0.6, 0.3, 0.0));
            smooth(&mesh, &mut refined, &[], smoothing, 50);
            assert!(refined.points[0].norm() < near, "{smoothing:?}: {}", refined.points[0]);
            assert_eq!(refined.points[1..], mesh.points()[1..]);
            let [MovedPoint { point: 0, cell, at }] = refined.moved[..] else { panic!() };
            let there = mesh.position(cell as usize, &at);
            assert!((there - refined.points[0]).norm() < 1e-12);
        }
    }

    #[test]
    fn interfaces_and_curved_points_stay() {
        let (mesh, mut refined) = wheel(Vector::new(0.6, 0.3, 0.0));
        smooth(&mesh, &mut refined, &[0, 0, 0, 1, 1, 1], Smoothing::Laplacian, 50);
        assert!(refined.points == mesh.points() && refined.moved.is_empty());
        let (mesh, mut refined) = wheel(Vector::new(0.6, 0.3, 0.1));
        smooth(&mesh, &mut refined, &[], Smoothing::Laplacian, 50);
        assert!(refined.points == mesh.points() && refined.moved.is_empty());
    }
}
