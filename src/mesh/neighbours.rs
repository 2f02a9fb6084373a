//! Which points share an edge.

use super::simplex_mesh::SimplexMesh;

/// For each point of a mesh, the points joined to it by an edge, ascending.
///
/// One array of neighbours and one of offsets into it, so memory is that of the
/// edges.
#[derive(Clone, Debug)]
pub struct PointNeighbours {
    offsets: Vec<usize>,
    neighbours: Vec<u32>,
}

impl PointNeighbours {
    /// The neighbours of all points of `mesh`.
    pub fn new<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>) -> Self {
        let directed = || {
            mesh.simplices().iter().flat_map(|corners| {
                let ends = corners.iter().flat_map(|&p| corners.iter().map(move |&q| (p, q)));
                ends.filter(|(p, q)| p != q)
            })
        };
        let mut ends = vec![0_usize; mesh.points().len() + 1];
        for (from, _) in directed() {
            ends[from as usize + 1] += 1;
        }
        for point in 1..ends.len() {
            ends[point] += ends[point - 1];
        }
        let mut next = ends.clone();
        let mut all = vec![0; *ends.last().unwrap_or(&0)];
        for (from, to) in directed() {
            all[next[from as usize]] = to;
            next[from as usize] += 1;
        }
        Self::without_repeats(&ends, &mut all)
    }

    /// An edge was met once in each of its simplices; keep one.
    fn without_repeats(ends: &[usize], all: &mut [u32]) -> Self {
        let mut offsets = vec![0];
        let mut neighbours = Vec::with_capacity(all.len() / 2 + 1);
        for bounds in ends.windows(2) {
            let own = &mut all[bounds[0]..bounds[1]];
            own.sort_unstable();
            for (place, &point) in own.iter().enumerate() {
                if place == 0 || own[place - 1] != point {
                    neighbours.push(point);
                }
            }
            offsets.push(neighbours.len());
        }
        Self { offsets, neighbours }
    }

    /// The points joined to `point` by an edge, ascending.
    pub fn of(&self, point: u32) -> &[u32] {
        let point = point as usize;
        &self.neighbours[self.offsets[point]..self.offsets[point + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::super::{TetrahedronMesh, TriangleMesh, Vector};
    use super::*;

    #[test]
    fn two_triangles_by_hand() {
        let points = vec![Vector::zeros(); 5];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [2, 1, 3]]).unwrap();
        let neighbours = PointNeighbours::new(&mesh);
        assert_eq!(neighbours.of(0), [1, 2]);
        assert_eq!(neighbours.of(1), [0, 2, 3]);
        assert_eq!(neighbours.of(3), [1, 2]);
        assert!(neighbours.of(4).is_empty());
    }

    #[test]
    fn two_tetrahedra_by_hand() {
        let points = vec![Vector::zeros(); 5];
        let mesh = TetrahedronMesh::new(points, vec![[0, 1, 2, 3], [2, 1, 3, 4]]).unwrap();
        let neighbours = PointNeighbours::new(&mesh);
        assert_eq!(neighbours.of(0), [1, 2, 3]);
        assert_eq!(neighbours.of(2), [0, 1, 3, 4]);
        assert_eq!(neighbours.of(4), [1, 2, 3]);
    }
}
