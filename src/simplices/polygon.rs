//! Polygons cut into triangles.

use super::left_out::Reason;
use crate::mesh::{Vector, plane_axes};

/// The most corners of a polygon that is cut: the work grows with their square.
pub const MOST_CORNERS: usize = 10_000;

/// A turn is none, as far as rounding can tell, if its triangle has less than this
/// fraction of the square of the polygon's size.
const FLAT: f64 = 1e-14;

/// Cuts polygons, convex or not, by taking off ears: corners whose triangle lies
/// inside and holds no other corner. Of all ears that with the shortest new side is
/// taken first, which gives compact triangles.
///
/// Source: G. H. Meisters, *Polygons have ears*, American Mathematical Monthly 82
/// (1975) 648-651.
#[derive(Debug, Default)]
pub struct PolygonCutter {
    /// The corners that are left: their points, and their places in the plane.
    points: Vec<u32>,
    places: Vec<[f64; 2]>,
    /// For each, the squared length of the side that takes it off; infinite if it
    /// is no ear.
    costs: Vec<f64>,
    /// Twice the area below which a triangle is flat.
    flat: f64,
}

impl PolygonCutter {
    /// Adds the triangles of a polygon, in its direction.
    ///
    /// # Errors
    /// If it has fewer than three distinct corners, too many, or edges that cross.
    pub fn cut(
        &mut self,
        corners: impl Iterator<Item = u32>,
        positions: &[Vector],
        triangles: &mut Vec<[u32; 3]>,
    ) -> Result<(), Reason> {
        self.points.clear();
        self.points.extend(corners);
        self.points.dedup();
        while self.points.len() > 1 && self.points.first() == self.points.last() {
            self.points.pop();
        }
        match self.points[..] {
            [] | [_] | [_, _] => return Err(Reason::Collapsed),
            [a, b, c] => {
                triangles.push([a, b, c]);
                return Ok(());
            }
            [a, b, c, d] => return cut_quad([a, b, c, d], positions, triangles),
            _ if self.points.len() > MOST_CORNERS => return Err(Reason::ManyCorners),
            _ => {}
        }
        self.flatten(positions);
        if self.crosses_itself() {
            return Err(Reason::CrossingEdges);
        }
        let start = triangles.len();
        self.take_off_ears(triangles).inspect_err(|_| triangles.truncate(start))
    }

    /// Projects the corners onto the polygon's plane, that of its area vector
    /// (Newell's); there it runs counter-clockwise.
    fn flatten(&mut self, positions: &[Vector]) {
        let at = |point: u32| positions[point as usize];
        let origin = at(self.points[0]);
        let area: Vector = (self.points.windows(2))
            .map(|pair| (at(pair[0]) - origin).cross(&(at(pair[1]) - origin)))
            .sum();
        let [right, up] = plane_axes(&area);
        let place = |&point: &u32| {
            let offset = at(point) - origin;
            [right.dot(&offset), up.dot(&offset)]
        };
        self.places.clear();
        self.places.extend(self.points.iter().map(place));
        let size = self.places.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
        self.flat = FLAT * size * size;
    }

    /// Whether two edges that are not neighbours meet.
    fn crosses_itself(&self) -> bool {
        let count = self.places.len();
        let edge = |n: usize| [self.places[n], self.places[(n + 1) % count]];
        (0..count).any(|first| {
            let last = if first == 0 { count - 1 } else { count };
            (first + 2..last).any(|second| self.meet(edge(first), edge(second)))
        })
    }

    /// Whether two edges cross, by the sides on which their ends lie.
    fn meet(&self, [a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
        let side = |p, q, r| {
            let area = doubled_area(p, q, r);
            if area.abs() <= self.flat { 0.0 } else { area.signum() }
        };
        side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
    }

    fn take_off_ears(&mut self, triangles: &mut Vec<[u32; 3]>) -> Result<(), Reason> {
        self.costs.clear();
        for corner in 0..self.points.len() {
            let cost = self.cost(corner);
            self.costs.push(cost);
        }
        while self.points.len() > 3 {
            let best =
                (0..self.costs.len()).min_by(|&a, &b| self.costs[a].total_cmp(&self.costs[b]));
            let Some(ear) = best.filter(|&ear| self.costs[ear].is_finite()) else {
                return if self.is_flat() { Ok(()) } else { Err(Reason::CrossingEdges) };
            };
            let [before, after] = self.neighbours(ear);
            triangles.push([before, ear, after].map(|corner| self.points[corner]));
            self.points.remove(ear);
            self.places.remove(ear);
            self.costs.remove(ear);
            // only its neighbours have other triangles now
            let after = ear % self.points.len();
            let before = (ear + self.points.len() - 1) % self.points.len();
            self.costs[before] = self.cost(before);
            self.costs[after] = self.cost(after);
        }
        triangles.extend(self.points.first_chunk());
        Ok(())
    }

    fn neighbours(&self, corner: usize) -> [usize; 2] {
        let count = self.points.len();
        [(corner + count - 1) % count, (corner + 1) % count]
    }

    /// The squared length of the side that takes a corner off; infinite if the
    /// corner is no ear.
    fn cost(&self, corner: usize) -> f64 {
        let [before, after] = self.neighbours(corner);
        let [a, b, c] = [before, corner, after].map(|corner| self.places[corner]);
        let holds = |p: [f64; 2]| {
            let inside = |from, to| doubled_area(from, to, p) >= -self.flat;
            inside(a, b) && inside(b, c) && inside(c, a)
        };
        let others = (0..self.places.len()).filter(|n| ![before, corner, after].contains(n));
        if doubled_area(a, b, c) > self.flat && !others.into_iter().any(|n| holds(self.places[n])) {
            (c[0] - a[0]).powi(2) + (c[1] - a[1]).powi(2)
        } else {
            f64::INFINITY
        }
    }

    /// Whether what is left has no area.
    fn is_flat(&self) -> bool {
        let doubled: f64 = (1..self.places.len() - 1)
            .map(|n| doubled_area(self.places[0], self.places[n], self.places[n + 1]))
            .sum();
        doubled.abs() <= self.flat * self.places.len() as f64
    }
}

fn doubled_area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Cuts a quad by the diagonal at its corner of lowest number; by the other one
/// if that would leave the quad.
fn cut_quad(
    mut corners: [u32; 4],
    positions: &[Vector],
    triangles: &mut Vec<[u32; 3]>,
) -> Result<(), Reason> {
    let lowest = (0..4).min_by_key(|&place| corners[place]).unwrap_or(0);
    corners.rotate_left(lowest);
    let [a, b, c, d] = corners;
    if a == c || b == d {
        // an edge there and back
        return Err(Reason::Collapsed);
    }
    let normal = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|point| positions[point as usize]);
        (b - a).cross(&(c - a))
    };
    let folds = |[one, other]: [[u32; 3]; 2]| normal(one).dot(&normal(other)) < 0.0;
    let cuts = [[[a, b, c], [a, c, d]], [[b, c, d], [b, d, a]]];
    let cut = cuts.into_iter().find(|&cut| !folds(cut)).ok_or(Reason::CrossingEdges)?;
    triangles.extend(cut);
    Ok(())
}
