//! The edges of triangles, each numbered once.

use rayon::slice::ParallelSliceMut;

use super::simplex_mesh::TriangleMesh;

/// The edges of a mesh of triangles, and which triangles they belong to.
///
/// An edge is its two points, whatever their order: any number of triangles may have it.
#[derive(Clone, Debug)]
pub struct NumberedEdges {
    of_triangles: Vec<[u32; 3]>,
    ends: Vec<[u32; 2]>,
    /// Where the triangles of each edge begin, and the end of the last.
    offsets: Vec<u32>,
    triangles: Vec<u32>,
}

impl NumberedEdges {
    /// The edges of `mesh`, in the order of their points.
    pub fn new(mesh: &TriangleMesh) -> Self {
        let mut named: Vec<([u32; 2], u32, u8)> = Vec::with_capacity(3 * mesh.triangles().len());
        for (triangle, points) in mesh.triangles().iter().enumerate() {
            for corner in 0..3 {
                let [a, b] = [points[(corner + 1) % 3], points[(corner + 2) % 3]];
                named.push(([a.min(b), a.max(b)], triangle as u32, corner as u8));
            }
        }
        named.par_sort_unstable();
        let mut of_triangles = vec![[0; 3]; mesh.triangles().len()];
        let (mut ends, mut offsets) = (Vec::new(), vec![0]);
        let mut triangles = Vec::with_capacity(named.len());
        for group in named.chunk_by(|left, right| left.0 == right.0) {
            for (_, triangle, corner) in group {
                of_triangles[*triangle as usize][usize::from(*corner)] = ends.len() as u32;
                triangles.push(*triangle);
            }
            ends.push(group[0].0);
            offsets.push(triangles.len() as u32);
        }
        Self { of_triangles, ends, offsets, triangles }
    }

    /// How many edges there are.
    pub fn count(&self) -> usize {
        self.ends.len()
    }

    /// The ends of each edge, the lesser first; ascending.
    pub fn ends(&self) -> &[[u32; 2]] {
        &self.ends
    }

    /// The edge between two points, if there is one.
    pub fn find(&self, a: u32, b: u32) -> Option<u32> {
        self.ends.binary_search(&[a.min(b), a.max(b)]).ok().map(|edge| edge as u32)
    }

    /// For each triangle, the edges opposite its corners.
    pub fn of_triangles(&self) -> &[[u32; 3]] {
        &self.of_triangles
    }

    /// The triangles of an edge, ascending: two inside a mesh, one on its boundary.
    pub fn triangles(&self, edge: u32) -> &[u32] {
        let [first, last] = [0, 1].map(|n| self.offsets[edge as usize + n] as usize);
        &self.triangles[first..last]
    }
}

#[cfg(test)]
mod tests {
    use super::super::Vector;
    use super::*;

    #[test]
    fn two_triangles_by_hand() {
        let mesh = TriangleMesh::new(vec![Vector::zeros(); 4], vec![[0, 1, 2], [2, 1, 3]]).unwrap();
        let edges = NumberedEdges::new(&mesh);
        assert_eq!(edges.ends(), [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]);
        assert_eq!(edges.of_triangles(), [[2, 1, 0], [3, 4, 2]]);
        assert_eq!(edges.triangles(2), [0, 1]);
        assert_eq!(edges.triangles(4), [1]);
        assert_eq!((edges.find(3, 1), edges.find(0, 3)), (Some(3), None));
    }
}
