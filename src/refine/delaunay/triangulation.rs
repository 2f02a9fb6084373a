//! The constrained Delaunay triangulation of a domain, and of what is around it.
//!
//! It begins with the cells as they are, so a mesh that is Delaunay costs no more than a look at
//! its edges. Each triangle knows its region, or that it is outside.

use rayon::prelude::*;
use spade::{Point2, mitigate_underflow};

use super::DelaunayError;
use super::curve::{Curve, mix};
use super::features::{Features, features, is_kept, sorted};
use super::linked::{Linked, LinkedTriangles, orientation};
use super::outside::add_outside;
use super::ties;

/// The constrained Delaunay triangulation of a domain.
pub struct Triangulation {
    cells: LinkedTriangles,
    pub features: Features,
    curves: Vec<Curve>,
}

/// The number of a face. When points are added another face may get it, which is near.
pub type FaceNumber = u32;

/// A face of the triangulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    pub number: FaceNumber,
    /// Its points, counter-clockwise.
    pub points: [u32; 3],
    pub corners: [Point2<f64>; 3],
}

/// What is met on the way from a face to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// The face that holds the place.
    Free(FaceNumber),
    /// A feature in between.
    Blocked([u32; 2]),
    /// The place is at no distance from a point, or cannot be reached for rounding.
    Lost,
}

/// What rounding cannot tell from zero.
const SAME: f64 = 1e-9;

/// A place is looked for in so many faces around the one that held it before points were added.
const FACES_AROUND: usize = 500;

impl Triangulation {
    /// The triangulation that begins with counter-clockwise `cells`, each with its region, and is
    /// made Delaunay: so where four points lie on a circle, the edge of the input stays. The
    /// faces have the numbers of the cells. `used`: the mesh's number of each point.
    ///
    /// # Errors
    /// If cells lie over one another, or no feature is on a curve.
    pub fn new(
        points: Vec<Point2<f64>>,
        cells: impl Iterator<Item = ([u32; 3], u32)>,
        used: &[u32],
        curves: Vec<Curve>,
    ) -> Result<Self, DelaunayError> {
        let mut linked = LinkedTriangles::new(points);
        let added = linked.add(cells.map(|(points, region)| Linked::new(points, Some(region))));
        let mut kept = added.map_err(|error| match error.count {
            2 => DelaunayError::CrossingEdges { ends: error.ends },
            _ => DelaunayError::Branching { ends: error.ends },
        })?;
        kept.retain(|pair| is_kept(pair, &linked));
        let features = features(&kept, &linked, used);
        add_outside(&mut linked, &features)?;
        let sides = kept.iter().filter_map(|pair| pair.sides[0].or(pair.sides[1]));
        sides.for_each(|side| linked.keep(side, true));
        let all = (0..linked.triangles().len() as u32).into_par_iter();
        let edges = all.flat_map_iter(|face| (0..3).map(move |corner| (face, corner)));
        let bad: Vec<_> = edges
            .filter(|&(face, corner)| {
                linked.triangle(face).borders[corner].beyond > face && linked.is_bad((face, corner))
            })
            .collect();
        linked.make_delaunay(bad);
        let all = Self { cells: linked, features, curves };
        let is_on_curve = |edge: &[u32; 2]| all.on_curve(*edge).is_some();
        if !all.curves.is_empty() && !all.features.keys().any(is_on_curve) {
            return Err(DelaunayError::NoEdgeOnCurves);
        }
        Ok(all)
    }

    /// How many points there are, with those around the domain.
    pub fn count(&self) -> usize {
        self.cells.positions.len()
    }

    /// Where a point is.
    pub fn position(&self, point: u32) -> Point2<f64> {
        self.cells.position(point)
    }

    /// The faces of the domain, and the region of each.
    pub fn faces(&self) -> impl IndexedParallelIterator<Item = Option<(Face, u32)>> {
        let all = self.cells.triangles().par_iter().enumerate();
        all.map(|(number, face)| Some((self.face(number as u32), face.side?)))
    }

    /// A face.
    fn face(&self, number: FaceNumber) -> Face {
        let points = self.cells.triangle(number).points;
        Face { number, points, corners: self.cells.corners(number) }
    }

    /// The face that holds a place, looked for around the one that did before points were added.
    pub fn locate(&self, place: Point2<f64>, around: FaceNumber) -> Option<Face> {
        let mut seen = vec![around];
        let mut next = 0;
        while let Some(&face) = seen.get(next) {
            let is_outside = |&corner: &usize| self.cells.side_of(face, corner, place) < 0.0;
            if !(0..3).any(|corner| is_outside(&corner)) {
                return Some(self.face(face));
            }
            if seen.len() < FACES_AROUND {
                let beyond = self.neighbours(face).filter(|beyond| !seen.contains(beyond));
                let beyond: arrayvec::ArrayVec<_, 3> = beyond.collect();
                seen.extend(beyond);
            }
            next += 1;
        }
        None
    }

    /// What is met on the straight way from the middle of a face to a place.
    pub fn way(&self, from: &Face, to: Point2<f64>) -> Way {
        let start = centroid(&from.corners);
        let mut face = from.number;
        let mut entry = None;
        for _ in 0..self.cells.triangles().len() {
            let ahead = (0..3).find(|&corner| {
                let [a, b] = self.edge_positions(face, corner);
                Some(corner) != entry
                    && self.cells.side_of(face, corner, to) < 0.0
                    && cross(start, to, a) <= 0.0
                    && cross(start, to, b) >= 0.0
            });
            let Some(corner) = ahead else {
                let holds = (0..3).all(|corner| self.cells.side_of(face, corner, to) >= 0.0);
                return if holds { Way::Free(face) } else { Way::Lost };
            };
            if self.cells.triangle(face).borders[corner].is_kept {
                return Way::Blocked(sorted(self.cells.triangle(face).edge(corner)));
            }
            let Some((next, corner)) = self.cells.twin((face, corner)) else { return Way::Lost };
            (face, entry) = (next, Some(corner));
        }
        Way::Lost
    }

    fn edge_positions(&self, face: FaceNumber, corner: usize) -> [Point2<f64>; 2] {
        self.cells.triangle(face).edge(corner).map(|point| self.position(point))
    }

    /// The features that a new point in the given face would see under more than a right angle.
    /// At a right angle, as in grids, triangles of 45 degrees are left.
    pub fn encroached(&self, place: Point2<f64>, face: FaceNumber) -> Vec<[u32; 2]> {
        let mut seen = vec![face];
        let mut next = 0;
        let mut found = Vec::new();
        while let Some(&face) = seen.get(next) {
            next += 1;
            for (corner, border) in self.cells.triangle(face).borders.iter().enumerate() {
                if border.is_kept {
                    let [a, b] = self.edge_positions(face, corner);
                    let dot = (a.x - place.x) * (b.x - place.x) + (a.y - place.y) * (b.y - place.y);
                    if dot < -SAME * a.distance_2(b) {
                        found.push(sorted(self.cells.triangle(face).edge(corner)));
                    }
                } else if !seen.contains(&border.beyond)
                    && self.cells.twin((face, corner)).is_some()
                    && self.cells.is_in_circle(border.beyond, place)
                {
                    seen.push(border.beyond);
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The numbers of the faces beside a face, not across features.
    pub fn neighbours(&self, face: FaceNumber) -> impl Iterator<Item = FaceNumber> {
        let inner = self.cells.triangle(face).borders.iter().filter(|border| !border.is_kept);
        inner.map(|border| border.beyond).filter(|&beyond| beyond != super::linked::NONE)
    }

    /// Adds a point inside the domain, looked for around a face; nothing if there is one already.
    pub fn insert(&mut self, place: Point2<f64>, around: FaceNumber) -> Option<u32> {
        let place = mitigate_underflow(place);
        let face = self.locate(place, around)?;
        if face.corners.contains(&place) || self.cells.triangle(face.number).side.is_none() {
            return None;
        }
        let on = (0..3).find(|&corner| self.cells.side_of(face.number, corner, place) == 0.0);
        match on {
            Some(corner) => self.insert_on((face.number, corner), place),
            None => Some(self.insert_in(face.number, place)),
        }
    }

    fn insert_in(&mut self, face: FaceNumber, place: Point2<f64>) -> u32 {
        let point = self.add_position(place);
        let around = self.cells.split(face, point);
        self.cells.make_delaunay(around.to_vec());
        point
    }

    /// Only where no feature is: these have points of their own.
    fn insert_on(&mut self, edge: (FaceNumber, usize), place: Point2<f64>) -> Option<u32> {
        if self.cells.triangle(edge.0).borders[edge.1].is_kept {
            return None;
        }
        self.cells.twin(edge)?;
        let point = self.add_position(place);
        let around = self.cells.split_edge(edge, point)?;
        self.cells.make_delaunay(around.to_vec());
        Some(point)
    }

    fn add_position(&mut self, place: Point2<f64>) -> u32 {
        self.cells.positions.push(place);
        self.cells.positions.len() as u32 - 1
    }

    /// Settles what Delaunay's rule leaves open around points of number `first_new` or above.
    /// Returns where points are to be added for that, each with a face near.
    pub fn settle_ties(&mut self, first_new: u32) -> Vec<(Point2<f64>, FaceNumber)> {
        ties::settle(&mut self.cells, first_new)
    }

    /// Halves a feature: at its middle, or where a curve has its own. Returns the new point.
    pub fn halve(&mut self, ends: [u32; 2], halvings: u8) -> Option<u32> {
        let feature = *self.features.get(&ends)?;
        let edge = self.cells.find(ends)?;
        let twin = self.cells.twin(edge)?;
        let place = mitigate_underflow(self.middle(ends));
        let point = if self.is_seen(edge, place) && self.is_seen(twin, place) {
            let point = self.add_position(place);
            let around = self.cells.split_edge(edge, point)?;
            self.cells.make_delaunay(around.to_vec());
            point
        } else {
            let from = [edge, twin].into_iter().find(|&edge| self.holds(edge.0, place))?;
            self.move_into(from, place)
        };
        self.features.remove(&ends);
        for (end, half) in ends.into_iter().zip(feature.halves(halvings)) {
            self.features.insert([end, point], half);
        }
        Some(point)
    }

    /// Whether the triangle beside an edge becomes two, both counter-clockwise, if a place is
    /// the edge's middle.
    fn is_seen(&self, edge: (FaceNumber, usize), place: Point2<f64>) -> bool {
        let [a, b] = self.edge_positions(edge.0, edge.1);
        let apex = self.position(self.cells.triangle(edge.0).points[edge.1]);
        orientation(apex, a, place) > 0.0 && orientation(apex, place, b) > 0.0
    }

    fn holds(&self, face: FaceNumber, place: Point2<f64>) -> bool {
        (0..3).all(|corner| self.cells.side_of(face, corner, place) > 0.0)
    }

    /// Two edges to a point inside the triangle beside a feature take its place. What lies
    /// between belongs to the other side then.
    fn move_into(&mut self, edge: (FaceNumber, usize), place: Point2<f64>) -> u32 {
        let [a, b] = self.cells.triangle(edge.0).edge(edge.1);
        let beyond = self.cells.twin(edge).and_then(|twin| self.cells.triangle(twin.0).side);
        let point = self.add_position(place);
        let mut around = self.cells.split(edge.0, point).to_vec();
        if let Some(old) = self.cells.find([a, b]) {
            self.cells.keep(old, false);
            self.cells.set_side(old.0, beyond);
            around.push(old);
        }
        for end in [a, b] {
            if let Some(half) = self.cells.find([end, point]) {
                self.cells.keep(half, true);
            }
        }
        self.cells.make_delaunay(around);
        point
    }

    /// Where a feature is halved: on a curve that has both its ends, if that place is in one
    /// of the triangles beside it, so that nothing else is in the way.
    fn middle(&self, edge: [u32; 2]) -> Point2<f64> {
        let beside = self.on_curve(edge).filter(|place| self.is_beside(edge, *place));
        beside.unwrap_or_else(|| {
            let [from, to] = edge.map(|point| self.position(point));
            mix(from, to, 0.5)
        })
    }

    /// The middle of the part of a curve between the ends of an edge, if they are on one.
    fn on_curve(&self, edge: [u32; 2]) -> Option<Point2<f64>> {
        let [from, to] = edge.map(|point| self.position(point));
        self.curves.iter().find_map(|curve| curve.between(from, to))
    }

    fn is_beside(&self, edge: [u32; 2], place: Point2<f64>) -> bool {
        let [from, to] = edge.map(|point| self.position(point));
        // no more than a half circle
        if mix(from, to, 0.5).distance_2(place) > 0.2501 * from.distance_2(to) {
            return false;
        }
        let edges = self.cells.find(edge).into_iter();
        let mut both = edges.flat_map(|edge| [Some(edge), self.cells.twin(edge)]).flatten();
        both.any(|(face, edge)| {
            let mut others = (0..3).filter(|&corner| corner != edge);
            let is_inside = |corner| self.cells.side_of(face, corner, place) > 0.0;
            self.cells.side_of(face, edge, place) >= 0.0 && others.all(is_inside)
        })
    }
}

/// The middle of a triangle.
pub fn centroid(corners: &[Point2<f64>; 3]) -> Point2<f64> {
    let [a, b, c] = corners;
    Point2::new((a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0)
}

/// Twice the area of a triangle, positive if counter-clockwise.
pub fn cross(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Refuses points at the same place, of which spade would keep one.
///
/// # Errors
/// [`DelaunayError::DuplicatePoints`]
pub fn refuse_duplicates(points: &[Point2<f64>]) -> Result<(), DelaunayError> {
    let mut order: Vec<(u64, u64, u32)> = points
        .iter()
        .zip(0..)
        // zeros of both signs are one
        .map(|(point, number)| ((point.x + 0.0).to_bits(), (point.y + 0.0).to_bits(), number))
        .collect();
    rayon::slice::ParallelSliceMut::par_sort_unstable(&mut order[..]);
    let twins = order.windows(2).filter(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1));
    match twins.map(|pair| [pair[0].2, pair[1].2]).min() {
        Some([first, second]) => Err(DelaunayError::DuplicatePoints { first, second }),
        None => Ok(()),
    }
}
