//! The faces of tetrahedra, each numbered once.

use rayon::slice::ParallelSliceMut;

use super::simplex_mesh::TetrahedronMesh;

/// The faces of a mesh of tetrahedra, and which tetrahedra they belong to.
///
/// A face is its three points, whatever their order: tetrahedra with the same three
/// points share it.
#[derive(Clone, Debug)]
pub struct Faces {
    of_tetrahedra: Vec<[u32; 4]>,
    /// Where the sides of each face begin, and the end of the last.
    offsets: Vec<usize>,
    sides: Vec<Side>,
}

/// One side of a face: the tetrahedron there, and its corner that is not on the face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// The tetrahedron.
    pub tetrahedron: u32,
    /// The corner opposite the face, 0 to 3.
    pub opposite: u8,
}

impl Side {
    /// The point of the tetrahedron that is not on the face.
    pub fn point(&self, mesh: &TetrahedronMesh) -> u32 {
        mesh.tetrahedra()[self.tetrahedron as usize][self.opposite as usize]
    }
}

impl Faces {
    /// The faces of `mesh`, in the order of their points.
    pub fn new(mesh: &TetrahedronMesh) -> Self {
        let mut named: Vec<([u32; 3], Side)> = Vec::with_capacity(4 * mesh.tetrahedra().len());
        for (tetrahedron, corners) in mesh.tetrahedra().iter().enumerate() {
            for opposite in 0..4 {
                let mut points = [1, 2, 3].map(|step| corners[(opposite + step) % 4]);
                points.sort_unstable();
                let side = Side { tetrahedron: tetrahedron as u32, opposite: opposite as u8 };
                named.push((points, side));
            }
        }
        named.par_sort_unstable();
        let mut of_tetrahedra = vec![[0; 4]; mesh.tetrahedra().len()];
        let mut offsets = vec![0];
        for group in named.chunk_by(|left, right| left.0 == right.0) {
            let face = offsets.len() - 1;
            for (_, side) in group {
                of_tetrahedra[side.tetrahedron as usize][side.opposite as usize] = face as u32;
            }
            offsets.push(offsets[face] + group.len());
        }
        let sides = named.into_iter().map(|(_, side)| side).collect();
        Self { of_tetrahedra, offsets, sides }
    }

    /// How many faces there are.
    pub fn count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// For each tetrahedron, the faces opposite its corners.
    pub fn of_tetrahedra(&self) -> &[[u32; 4]] {
        &self.of_tetrahedra
    }

    /// The sides of a face, ascending: two inside a mesh, one on its boundary.
    pub fn sides(&self, face: usize) -> &[Side] {
        &self.sides[self.offsets[face]..self.offsets[face + 1]]
    }

    /// What lies beyond the face opposite a corner of a tetrahedron of `mesh`: the one other
    /// side of that face. None on the boundary, where three tetrahedra or more have the
    /// face, and beyond which the same tetrahedron lies once more.
    pub fn beyond(
        &self,
        mesh: &TetrahedronMesh,
        tetrahedron: usize,
        opposite: usize,
    ) -> Option<Side> {
        let sides = self.sides(self.of_tetrahedra[tetrahedron][opposite] as usize);
        let [first, second] = sides else { return None };
        let other = if first.tetrahedron as usize == tetrahedron { second } else { first };
        let is_new = other.point(mesh) != mesh.tetrahedra()[tetrahedron][opposite];
        is_new.then_some(*other)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Vector;
    use super::*;

    #[test]
    fn two_tetrahedra_by_hand() {
        let points = vec![Vector::zeros(); 5];
        let mesh = TetrahedronMesh::new(points, vec![[0, 1, 2, 3], [2, 4, 3, 1]]).unwrap();
        let faces = Faces::new(&mesh);
        assert_eq!(faces.count(), 7);
        let shared = faces.of_tetrahedra()[0][0];
        assert_eq!(faces.of_tetrahedra()[1][1], shared);
        let sides = [Side { tetrahedron: 0, opposite: 0 }, Side { tetrahedron: 1, opposite: 1 }];
        assert_eq!(faces.sides(shared as usize), sides);
        let alone = (0..7).filter(|&face| faces.sides(face).len() == 1).count();
        assert_eq!(alone, 6);
        assert_eq!(faces.beyond(&mesh, 0, 0), Some(sides[1]));
        assert_eq!(faces.beyond(&mesh, 1, 1), Some(sides[0]));
        assert_eq!(faces.beyond(&mesh, 0, 1), None);
        assert_eq!(sides.map(|side| side.point(&mesh)), [0, 4]);
    }

    #[test]
    fn nothing_is_beyond_where_three_meet_or_one_is_twice_there() {
        let points = || vec![Vector::zeros(); 6];
        let three = vec![[0, 1, 2, 3], [1, 2, 3, 4], [1, 2, 3, 5]];
        for tetrahedra in [three, vec![[0, 1, 2, 3], [1, 2, 3, 0]]] {
            let mesh = TetrahedronMesh::new(points(), tetrahedra).unwrap();
            assert_eq!(Faces::new(&mesh).beyond(&mesh, 0, 0), None);
        }
    }
}
