//! The points around one point, ring by ring.

use arrayvec::ArrayVec;

use crate::mesh::PointNeighbours;

/// Rings of neighbours beyond which a patch does not grow.
pub(super) const MAX_RINGS: usize = 4;

/// Points beyond which a patch does not grow: several times what a cubic needs.
const MAX_POINTS: usize = 160;

/// A patch that grows ring by ring; kept between points so that its memory is used
/// again.
#[derive(Default)]
pub(super) struct Patch {
    /// The point itself first, then its neighbours in order of distance in edges.
    points: Vec<u32>,
    /// Where the point itself and each of the rings end.
    ends: ArrayVec<usize, { MAX_RINGS + 1 }>,
}

impl Patch {
    /// The patch of one point alone.
    pub fn start(&mut self, point: u32) {
        self.points.clear();
        self.points.push(point);
        self.ends.clear();
        self.ends.push(1);
    }

    /// How many rings there are.
    pub fn rings(&self) -> usize {
        self.ends.len() - 1
    }

    /// The points of the first rings, without the point itself.
    pub fn within(&self, rings: usize) -> &[u32] {
        &self.points[1..self.ends[rings.min(self.rings())]]
    }

    /// Adds the next ring; false if there is none, or the patch is full.
    pub fn grow(&mut self, neighbours: &PointNeighbours) -> bool {
        if self.rings() == MAX_RINGS {
            return false;
        }
        let end = self.points.len();
        let outermost = self.ends.iter().rev().nth(1).copied().unwrap_or(0);
        for place in outermost..end {
            let around = neighbours.of(self.points[place]);
            // of a great fan, points all around it
            let step = around.len().div_ceil(MAX_POINTS).max(1);
            for &point in around.iter().step_by(step) {
                // patches are small: a search is faster than a set
                if self.points.len() < MAX_POINTS && !self.points.contains(&point) {
                    self.points.push(point);
                }
            }
        }
        let grown = self.points.len() > end;
        if grown {
            self.ends.push(self.points.len());
        }
        grown
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{TriangleMesh, Vector};

    #[test]
    fn rings_of_a_strip_by_hand() {
        let triangles = (0..5).map(|n| [n, n + 1, n + 2]).collect();
        let mesh = TriangleMesh::new(vec![Vector::zeros(); 7], triangles).unwrap();
        let neighbours = PointNeighbours::new(&mesh);
        let mut patch = Patch::default();
        patch.start(0);
        assert!(patch.within(1).is_empty());
        for _ in 0..3 {
            assert!(patch.grow(&neighbours));
        }
        assert_eq!([1, 2, 3].map(|rings| patch.within(rings).len()), [2, 4, 6]);
        assert!(!patch.grow(&neighbours));
        assert_eq!(patch.within(MAX_RINGS), [1, 2, 3, 4, 5, 6]);
    }
}
