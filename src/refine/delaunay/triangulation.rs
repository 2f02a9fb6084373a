//! The constrained Delaunay triangulation of a domain.
//!
//! spade's triangulation covers the convex hull. Which of its faces belong to the domain, and
//! to which region, follows from the features: each knows what lies on both its sides.

use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{
    ConstrainedDelaunayTriangulation, Point2, PositionInTriangulation, Triangulation as _,
};

use super::DelaunayError;
use super::curve::{Curve, mix};
use super::features::{Features, Side, sorted};

type Spade = ConstrainedDelaunayTriangulation<Point2<f64>>;
type FaceHandle<'a> =
    spade::handles::FaceHandle<'a, InnerTag, Point2<f64>, (), spade::CdtEdge<()>, ()>;
type EdgeHandle<'a> =
    spade::handles::DirectedEdgeHandle<'a, Point2<f64>, (), spade::CdtEdge<()>, ()>;

/// The constrained Delaunay triangulation of a domain. Points have the numbers of spade's
/// vertices.
pub struct Triangulation {
    spade: Spade,
    pub features: Features,
    curves: Vec<Curve>,
}

/// The number of a face, until a point is added.
pub type FaceNumber = FixedFaceHandle<InnerTag>;

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

impl Triangulation {
    /// The triangulation of `points`, which begins with the given `edges` and is made
    /// Delaunay: so where four points lie on a circle, the edge of the input stays.
    ///
    /// # Errors
    /// If edges cross, or no feature is on a curve.
    pub fn new(
        points: Vec<Point2<f64>>,
        edges: &[[usize; 2]],
        features: Features,
        curves: Vec<Curve>,
    ) -> Result<Self, DelaunayError> {
        let mut crossing = Vec::new();
        let loaded = Spade::try_bulk_load_cdt(points, edges.to_vec(), |edge| crossing.push(edge));
        let Ok(mut spade) = loaded else { return Err(DelaunayError::TooLarge) };
        // an edge through a point became several
        if spade.num_constraints() != edges.len() {
            let is_missing = |[from, to]: &&[usize; 2]| {
                !spade.exists_constraint(handle(*from as u32), handle(*to as u32))
            };
            crossing.extend(edges.iter().find(is_missing));
        }
        if let Some(edge) = crossing.iter().min() {
            let ends = sorted(edge.map(|point| point as u32));
            return Err(DelaunayError::CrossingEdges { ends });
        }
        let free: Vec<_> = spade
            .undirected_edges()
            .filter(|edge| {
                let ends = edge.vertices().map(|vertex| vertex.index() as u32);
                edge.is_constraint_edge() && !features.contains_key(&sorted(ends))
            })
            .map(|edge| edge.vertices().map(|vertex| vertex.fix()))
            .collect();
        for [from, to] in free {
            // edges removed before may have turned others, never one that is still kept
            if let Some(edge) = spade.get_edge_from_neighbors(from, to) {
                let edge = edge.as_undirected().fix();
                spade.remove_constraint_edge(edge);
            }
        }
        let all = Self { spade, features, curves };
        let is_on_curve = |edge: &[u32; 2]| all.on_curve(*edge).is_some();
        if !all.curves.is_empty() && !all.features.keys().any(is_on_curve) {
            return Err(DelaunayError::NoEdgeOnCurves);
        }
        Ok(all)
    }

    /// How many points there are.
    pub fn count(&self) -> usize {
        self.spade.num_vertices()
    }

    /// Where a point is.
    pub fn position(&self, point: u32) -> Point2<f64> {
        self.spade.vertex(handle(point)).position()
    }

    /// The faces of the domain, and the region of each.
    pub fn faces(&self) -> Vec<(Face, u32)> {
        let mut regions: Vec<Option<Side>> = vec![None; self.spade.num_all_faces()];
        let mut open = Vec::new();
        for (&[low, high], feature) in &self.features {
            let edge = self.spade.get_edge_from_neighbors(handle(low), handle(high));
            let Some(edge) = edge else { continue };
            for (edge, side) in [edge, edge.rev()].into_iter().zip(feature.sides) {
                open.extend(edge.face().as_inner().map(|face| (face, side)));
            }
        }
        while let Some((face, side)) = open.pop() {
            if regions[face.index()].replace(side).is_some() {
                continue;
            }
            for edge in face.adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge()) {
                let next = edge.rev().face().as_inner();
                let unknown = next.filter(|next| regions[next.index()].is_none());
                open.extend(unknown.map(|next| (next, side)));
            }
        }
        let faces = self.spade.inner_faces().filter_map(|face| {
            let region = regions[face.index()].flatten()?;
            Some((described(face), region))
        });
        faces.collect()
    }

    /// The face that holds a place, looked for from a point near it.
    pub fn locate(&self, place: Point2<f64>, near: u32) -> Option<Face> {
        use PositionInTriangulation::{OnEdge, OnFace};
        let face = match self.spade.locate_with_hint(place, handle(near)) {
            OnFace(face) => Some(self.spade.face(face)),
            OnEdge(edge) => self.spade.directed_edge(edge).face().as_inner(),
            _ => None,
        };
        face.map(described)
    }

    /// What is met on the straight way from the middle of a face to a place.
    pub fn way(&self, from: &Face, to: Point2<f64>) -> Way {
        let start = centroid(&from.corners);
        let mut face = self.face(from.number);
        let mut entry: Option<EdgeHandle> = None;
        for _ in 0..self.spade.num_all_faces() {
            let ahead = face.adjacent_edges().into_iter().find(|edge| {
                let [a, b] = edge.positions();
                Some(*edge) != entry
                    && edge.side_query(to).is_on_right_side()
                    && cross(start, to, a) <= 0.0
                    && cross(start, to, b) >= 0.0
            });
            let Some(edge) = ahead else {
                let inside = face.adjacent_edges().into_iter();
                let holds = inside.clone().all(|edge| !edge.side_query(to).is_on_right_side());
                return if holds { Way::Free(face.fix()) } else { Way::Lost };
            };
            if edge.is_constraint_edge() {
                return Way::Blocked(ends(edge));
            }
            let Some(next) = edge.rev().face().as_inner() else { return Way::Lost };
            (face, entry) = (next, Some(edge.rev()));
        }
        Way::Lost
    }

    /// The features that a new point in the given face would see under more than a right angle.
    /// At a right angle, as in grids, triangles of 45 degrees are left.
    pub fn encroached(&self, place: Point2<f64>, face: FaceNumber) -> Vec<[u32; 2]> {
        let mut seen = vec![face];
        let mut next = 0;
        let mut found = Vec::new();
        while next < seen.len() {
            let face = self.face(seen[next]);
            next += 1;
            for edge in face.adjacent_edges() {
                if edge.is_constraint_edge() {
                    let [a, b] = edge.positions();
                    let dot = (a.x - place.x) * (b.x - place.x) + (a.y - place.y) * (b.y - place.y);
                    if dot < -SAME * a.distance_2(b) {
                        found.push(ends(edge));
                    }
                } else if let Some(beyond) = edge.rev().face().as_inner() {
                    let (centre, radius) = beyond.circumcircle();
                    if !seen.contains(&beyond.fix()) && centre.distance_2(place) < radius {
                        seen.push(beyond.fix());
                    }
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The numbers of the faces beside a face, not across features.
    pub fn neighbours(&self, face: FaceNumber) -> impl Iterator<Item = FaceNumber> {
        let edges = self.face(face).adjacent_edges().into_iter();
        let inner = edges.filter(|edge| !edge.is_constraint_edge());
        inner.filter_map(|edge| edge.rev().face().as_inner().map(|face| face.fix()))
    }

    /// Adds a point inside the domain; nothing if there is one already.
    pub fn insert(&mut self, place: Point2<f64>, near: u32) -> Option<u32> {
        let before = self.count();
        let vertex = self.spade.insert_with_hint(place, handle(near)).ok()?;
        (self.count() > before).then_some(vertex.index() as u32)
    }

    /// Halves a feature: at its middle, or where a curve has its own. Returns the new point.
    pub fn halve(&mut self, edge: [u32; 2], halvings: u8) -> Option<u32> {
        let feature = *self.features.get(&edge)?;
        let place = self.middle(edge);
        let [from, to] = edge.map(handle);
        let kept = self.spade.get_edge_from_neighbors(from, to)?.as_undirected().fix();
        // a middle is beside its edge for rounding, and must not find it in its way
        self.spade.remove_constraint_edge(kept);
        let before = self.count();
        let vertex = self.spade.insert_with_hint(place, from).ok();
        let Some(vertex) = vertex.filter(|_| self.count() > before) else {
            self.spade.add_constraint(from, to);
            return None;
        };
        self.features.remove(&edge);
        for (end, half) in [from, to].into_iter().zip(feature.halves(halvings)) {
            self.spade.add_constraint(end, vertex);
            self.features.insert([end.index() as u32, vertex.index() as u32], half);
        }
        Some(vertex.index() as u32)
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
        let [low, high] = edge.map(handle);
        let Some(edge) = self.spade.get_edge_from_neighbors(low, high) else { return false };
        let edge = if edge.side_query(place).is_on_left_side() { edge } else { edge.rev() };
        match edge.face().as_inner() {
            // beyond the hull there is nothing
            None => true,
            Some(face) => {
                let mut others = face.adjacent_edges().into_iter().filter(|other| *other != edge);
                others.all(|other| other.side_query(place).is_on_left_side())
            }
        }
    }

    fn face(&self, number: FaceNumber) -> FaceHandle<'_> {
        self.spade.face(number)
    }
}

fn handle(point: u32) -> FixedVertexHandle {
    FixedVertexHandle::from_index(point as usize)
}

fn ends(edge: EdgeHandle) -> [u32; 2] {
    sorted(edge.vertices().map(|vertex| vertex.index() as u32))
}

fn described(face: FaceHandle) -> Face {
    Face {
        number: face.fix(),
        points: face.vertices().map(|vertex| vertex.index() as u32),
        corners: face.positions(),
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
