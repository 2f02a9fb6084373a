//! The edges of triangles, and what lies beyond them.

use super::simplex_mesh::TriangleMesh;

/// For each edge of a mesh of triangles, the triangles that have it.
///
/// Edges stand at their lesser point, so finding one is a search among the few edges of
/// a point, and nothing is sorted.
#[derive(Clone, Debug)]
pub struct Edges<'a> {
    mesh: &'a TriangleMesh<'a>,
    /// Where the edges at each point begin, and the end of the last.
    offsets: Vec<u32>,
    sides: Vec<Side>,
}

/// A triangle at an edge.
#[derive(Clone, Copy, Debug, Default)]
struct Side {
    /// The greater point of the edge.
    end: u32,
    /// The triangle.
    triangle: u32,
}

impl<'a> Edges<'a> {
    /// The edges of `mesh`.
    pub fn new(mesh: &'a TriangleMesh<'a>) -> Self {
        let edges = || {
            mesh.triangles().iter().enumerate().flat_map(|(triangle, points)| {
                (0..3).map(move |corner| (triangle as u32, ends(points, corner)))
            })
        };
        let mut offsets = vec![0_u32; mesh.points().len() + 1];
        for (_, [start, _]) in edges() {
            offsets[start as usize + 1] += 1;
        }
        for point in 1..offsets.len() {
            offsets[point] += offsets[point - 1];
        }
        let mut next = offsets.clone();
        let mut sides = vec![Side::default(); 3 * mesh.triangles().len()];
        for (triangle, [start, end]) in edges() {
            let place = &mut next[start as usize];
            sides[*place as usize] = Side { end, triangle };
            *place += 1;
        }
        Self { mesh, offsets, sides }
    }

    /// The point beyond the edge opposite a corner of a triangle: the third of the one
    /// other triangle that has this edge. None on the boundary, where three triangles
    /// or more meet, and beyond which the same triangle lies once more.
    pub fn point_beyond(&self, triangle: usize, corner: usize) -> Option<u32> {
        let points = &self.mesh.triangles()[triangle];
        let edge = ends(points, corner);
        let [first, last] = [0, 1].map(|n| self.offsets[edge[0] as usize + n] as usize);
        let others = self.sides[first..last].iter();
        let mut others =
            others.filter(|side| side.end == edge[1] && side.triangle as usize != triangle);
        let (Some(other), None) = (others.next(), others.next()) else { return None };
        let beyond = self.mesh.triangles()[other.triangle as usize];
        beyond.into_iter().find(|point| !edge.contains(point)).filter(|&p| p != points[corner])
    }
}

/// The ends of the edge opposite a corner, the lesser first.
fn ends(points: &[u32; 3], corner: usize) -> [u32; 2] {
    let [a, b] = [points[(corner + 1) % 3], points[(corner + 2) % 3]];
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::super::Vector;
    use super::*;

    fn beyond(triangles: Vec<[u32; 3]>) -> Vec<[Option<u32>; 3]> {
        let mesh = TriangleMesh::new(vec![Vector::zeros(); 6], triangles).unwrap();
        let edges = Edges::new(&mesh);
        let of = |triangle| [0, 1, 2].map(|corner| edges.point_beyond(triangle, corner));
        (0..mesh.triangles().len()).map(of).collect()
    }

    #[test]
    fn two_triangles_by_hand() {
        let found = beyond(vec![[0, 1, 2], [2, 1, 3]]);
        assert_eq!(found, [[Some(3), None, None], [None, None, Some(0)]]);
    }

    #[test]
    fn nothing_is_beyond_where_three_meet_or_one_is_twice_there() {
        assert_eq!(beyond(vec![[0, 1, 2], [2, 1, 3], [1, 2, 4]])[0], [None; 3]);
        assert_eq!(beyond(vec![[0, 1, 2], [1, 2, 0]]), [[None; 3]; 2]);
    }
}
