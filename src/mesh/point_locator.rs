//! Which simplex a point lies in, or which one is nearest to it.
//!
//! The simplices are put in the order of a curve that keeps neighbours together (Morton
//! 1966), and a binary tree of boxes is laid over them: a box of a few simplices at each
//! leaf, the box of both children at each node above. A query goes into the nearer child
//! first and passes over boxes that are further than what it has found. Unlike a grid of
//! equal buckets this does not care how the mesh is graded, nor whether its triangles
//! fill a plane or are a surface in space.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::closest_point::closest_point;
use super::{SimplexMesh, Vector};

/// Finds points in a mesh. It holds no mesh: each query is given the one it was made of.
///
/// Making it takes the time of a sort of the simplices; its memory is at most 28 bytes a
/// simplex. A query takes a time logarithmic in their number.
#[derive(Clone, Debug)]
pub struct PointLocator {
    /// The simplices, neighbours near one another.
    order: Vec<u32>,
    /// The tree: the children of node `n` are `2n + 1` and `2n + 2`, and the leaves are
    /// the last half, a power of two.
    boxes: Vec<Bounds>,
}

/// Where a point is in a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Location<const CORNERS: usize> {
    /// The simplex that holds the point, or is nearest to it.
    pub simplex: usize,
    /// Barycentric coordinates of the simplex's point that is nearest: of the point
    /// itself if it lies inside. None is negative.
    pub at: [f64; CORNERS],
    /// How far the point is from there: zero, but for rounding, if it lies inside.
    pub distance: f64,
}

/// Simplices in a leaf: fewer make the tree larger, more make it slower.
const LEAF: usize = 4;

/// More than a tree over all 32-bit numbers is deep.
const DEPTH: usize = 64;

impl PointLocator {
    /// The locator of a mesh. Simplices with a corner that is not finite are not found.
    pub fn new<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>) -> Self {
        let bounds = |simplex: usize| Bounds::around(&mesh.corners(simplex));
        let count = mesh.simplices().len();
        let finite: Vec<u32> = (0..count as u32)
            .into_par_iter()
            .filter(|&simplex| bounds(simplex as usize).is_finite())
            .collect();
        let whole = finite
            .par_iter()
            .map(|&simplex| bounds(simplex as usize))
            .reduce(|| Bounds::EMPTY, |one, other| one.union(&other));
        let mut keyed: Vec<(u64, u32)> = finite
            .into_par_iter()
            .map(|simplex| (whole.morton(&bounds(simplex as usize).centre()), simplex))
            .collect();
        keyed.par_sort_unstable();
        let order: Vec<u32> = keyed.into_par_iter().map(|(_, simplex)| simplex).collect();
        let boxes = tree(&order, bounds);
        Self { order, boxes }
    }

    /// A distance that forgives points in single precision, and those computed on the
    /// boundary: a millionth of the diagonal of the mesh's box.
    pub fn forgiving_distance(&self) -> f64 {
        let Bounds { low, high } = self.boxes[0];
        if self.order.is_empty() { 0.0 } else { 1e-6 * (high - low).norm() }
    }

    /// Where a point is in the mesh, or where its nearest point is, if that is not
    /// further than `within` (a length; infinity to find one in any case).
    ///
    /// Of simplices that are equally near, as on an edge, the one found is always the
    /// same. A point that is not finite is nowhere.
    pub fn locate<const CORNERS: usize>(
        &self,
        mesh: &SimplexMesh<CORNERS>,
        point: &Vector,
        within: f64,
    ) -> Option<Location<CORNERS>> {
        if !point.iter().all(|x| x.is_finite()) {
            return None;
        }
        let mut nearest: Option<Location<CORNERS>> = None;
        let mut open = ArrayVec::<usize, DEPTH>::new();
        open.push(0);
        while let Some(node) = open.pop() {
            let reach = nearest.map_or(within, |found| found.distance);
            let distance = self.boxes[node].distance(point);
            if distance > reach || (nearest.is_some() && distance >= reach) {
                continue;
            }
            let (left, right) = (2 * node + 1, 2 * node + 2);
            if let Some(leaf) = self.leaf(node) {
                nearest = nearest_of(mesh, leaf, point, reach, nearest);
            } else if self.boxes[left].distance(point) <= self.boxes[right].distance(point) {
                open.extend([right, left]);
            } else {
                open.extend([left, right]);
            }
        }
        nearest
    }

    /// The simplices of a leaf.
    fn leaf(&self, node: usize) -> Option<&[u32]> {
        let first = self.boxes.len() / 2;
        let start = (node.checked_sub(first)? * LEAF).min(self.order.len());
        Some(&self.order[start..(start + LEAF).min(self.order.len())])
    }
}

/// The nearest of some simplices and what was found before.
fn nearest_of<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    simplices: &[u32],
    point: &Vector,
    mut reach: f64,
    mut nearest: Option<Location<CORNERS>>,
) -> Option<Location<CORNERS>> {
    for &simplex in simplices {
        let simplex = simplex as usize;
        let (at, distance) = closest_point(&mesh.corners(simplex), point);
        if distance < reach || (nearest.is_none() && distance <= reach) {
            reach = distance;
            nearest = Some(Location { simplex, at, distance });
        }
    }
    nearest
}

/// The boxes of the tree, root first.
fn tree(order: &[u32], bounds: impl Fn(usize) -> Bounds + Sync) -> Vec<Bounds> {
    let leaves = order.len().div_ceil(LEAF).next_power_of_two();
    let mut boxes = vec![Bounds::EMPTY; 2 * leaves - 1];
    let (above, below) = boxes.split_at_mut(leaves - 1);
    below.par_iter_mut().zip(order.par_chunks(LEAF)).for_each(|(leaf, simplices)| {
        for &simplex in simplices {
            *leaf = leaf.union(&bounds(simplex as usize));
        }
    });
    for node in (0..above.len()).rev() {
        boxes[node] = boxes[2 * node + 1].union(&boxes[2 * node + 2]);
    }
    boxes
}

/// A box with sides along the axes.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: Vector,
    high: Vector,
}

impl Bounds {
    /// What every box contains; infinitely far from any point.
    const EMPTY: Self = Self {
        low: Vector::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vector::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The box of some points; not finite if one of them is not.
    fn around(points: &[Vector]) -> Self {
        let mut bounds = Self::EMPTY;
        for point in points {
            if !point.iter().all(|x| x.is_finite()) {
                return Self::EMPTY;
            }
            bounds = bounds.union(&Self { low: *point, high: *point });
        }
        bounds
    }

    fn is_finite(&self) -> bool {
        self.low.iter().chain(&self.high).all(|x| x.is_finite())
    }

    fn union(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    fn centre(&self) -> Vector {
        self.low * 0.5 + self.high * 0.5
    }

    /// How far a point is from the box; zero inside.
    fn distance(&self, point: &Vector) -> f64 {
        let outside = (self.low - point).sup(&(point - self.high));
        outside.sup(&Vector::zeros()).norm()
    }

    /// The place of a point of the box on Morton's curve: the bits of its three
    /// coordinates, in units of the longest side, in turn.
    fn morton(&self, point: &Vector) -> u64 {
        const BITS: i32 = 21;
        let cells = f64::from(1 << BITS) - 1.0;
        let longest = (self.high - self.low).max();
        let unit = if longest > 0.0 { cells / longest } else { 0.0 };
        let places = (point - self.low).map(|offset| (offset * unit) as u64);
        let bit = |bit: i32| places.iter().fold(0, |key, place| key << 1 | (place >> bit & 1));
        (0..BITS).rev().fold(0, |key, place| key << 3 | bit(place))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{TetrahedronMesh, TriangleMesh};
    use super::*;

    #[test]
    fn two_triangles_by_hand() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let points = points.map(|[x, y]| Vector::new(x, y, 0.0)).to_vec();
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let locator = PointLocator::new(&mesh);
        let find =
            |x: f64, y: f64, within: f64| locator.locate(&mesh, &Vector::new(x, y, 0.0), within);
        let below = Location { simplex: 0, at: [0.25, 0.5, 0.25], distance: 0.0 };
        assert_eq!(find(0.75, 0.25, 0.0), Some(below));
        assert_eq!(find(0.25, 0.75, 0.0).map(|found| found.simplex), Some(1));
        assert!(find(0.5, 0.5, 0.0).is_some());
        assert_eq!(find(1.5, 0.5, 0.4), None);
        let beside = Location { simplex: 0, at: [0.0, 0.5, 0.5], distance: 0.5 };
        assert_eq!(find(1.5, 0.5, 0.5), Some(beside));
        assert_eq!(find(f64::NAN, 0.5, f64::INFINITY), None);
    }

    #[test]
    fn meshes_of_nothing() {
        let none = TriangleMesh::new(Vec::new(), Vec::new()).unwrap();
        let locator = PointLocator::new(&none);
        assert_eq!(locator.locate(&none, &Vector::zeros(), f64::INFINITY), None);
        assert_eq!(locator.forgiving_distance(), 0.0);
        let nan = vec![Vector::repeat(f64::NAN), Vector::x(), Vector::y(), Vector::z()];
        let nan = TetrahedronMesh::new(nan, vec![[0, 1, 2, 3]]).unwrap();
        assert_eq!(PointLocator::new(&nan).locate(&nan, &Vector::x(), f64::INFINITY), None);
    }

    #[test]
    fn morton_keys_interleave() {
        let unit = Bounds { low: Vector::zeros(), high: Vector::repeat(2_097_151.0) };
        assert_eq!(unit.morton(&Vector::new(1.0, 0.0, 0.0)), 0b100);
        assert_eq!(unit.morton(&Vector::new(2.0, 3.0, 1.0)), 0b110_011);
    }
}
