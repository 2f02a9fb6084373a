//! The boundary of a mesh.

use rayon::slice::ParallelSliceMut;

use super::simplex_mesh::TriangleMesh;

/// The edges that belong to exactly one triangle, as pairs of points in the
/// direction of that triangle, sorted by their points.
pub fn boundary_edges(mesh: &TriangleMesh) -> Vec<[u32; 2]> {
    let mut edges: Vec<([u32; 2], bool)> = mesh
        .triangles()
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| if a < b { ([a, b], false) } else { ([b, a], true) })
        .collect();
    edges.par_sort_unstable();
    edges
        .chunk_by(|left, right| left.0 == right.0)
        .filter(|group| group.len() == 1)
        .map(|group| match group[0] {
            (edge, false) => edge,
            ([a, b], true) => [b, a],
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::Vector;
    use super::*;

    #[test]
    fn the_shared_edge_is_not_on_the_boundary() {
        let points = vec![Vector::zeros(); 4];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [2, 1, 3]]).unwrap();
        assert_eq!(boundary_edges(&mesh), [[0, 1], [2, 0], [1, 3], [3, 2]]);
    }
}
