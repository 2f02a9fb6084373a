//! The faces of tetrahedra, each numbered once.

use rayon::prelude::*;

use super::simplex_mesh::TetrahedronMesh;

/// The faces of a mesh of tetrahedra, and which tetrahedra they belong to.
///
/// A face is its three points, whatever their order: tetrahedra with the same three
/// points share it. They are numbered in the order of their points, so that the tetrahedra of some
/// that follow each other stand close together if the points do. Forty bytes a tetrahedron are
/// kept, and hardly more is needed to find them.
#[derive(Clone, Debug)]
pub struct Faces {
    of_tetrahedra: Vec<[u32; 4]>,
    /// Where the sides of each face begin, and the end of the last.
    offsets: Vec<u32>,
    sides: Vec<Side>,
}

/// One side of a face: the tetrahedron there, and its corner that is not on the face.
///
/// Both in one number: a mesh has at most 2³⁰ tetrahedra ([`super::MeshError::TooMany`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side(u32);

impl Side {
    fn new(tetrahedron: usize, opposite: usize) -> Self {
        Self(4 * tetrahedron as u32 + opposite as u32)
    }

    /// The tetrahedron.
    pub fn tetrahedron(self) -> usize {
        self.0 as usize / 4
    }

    /// The corner opposite the face, 0 to 3.
    pub fn opposite(self) -> usize {
        self.0 as usize % 4
    }

    /// The point of the tetrahedron that is not on the face.
    pub fn point(self, mesh: &TetrahedronMesh) -> u32 {
        mesh.tetrahedra()[self.tetrahedron()][self.opposite()]
    }

    /// The points of the face, ascending.
    pub fn face(self, mesh: &TetrahedronMesh) -> [u32; 3] {
        let corners = mesh.tetrahedra()[self.tetrahedron()];
        let mut points = [1, 2, 3].map(|step| corners[(self.opposite() + step) % 4]);
        points.sort_unstable();
        points
    }
}

impl Faces {
    /// The faces of `mesh`, in the order of their points.
    pub fn new(mesh: &TetrahedronMesh) -> Self {
        let (mut sides, ends) = by_least_point(mesh);
        let mut blocks = Vec::new();
        let mut rest = &mut sides[..];
        for (point, &end) in ends.iter().enumerate() {
            let begin = if point == 0 { 0 } else { ends[point - 1] };
            let (block, after) = rest.split_at_mut((end - begin) as usize);
            // of a part of a mesh many points have none
            if !block.is_empty() {
                blocks.push(block);
            }
            rest = after;
        }
        blocks.into_par_iter().for_each_init(Vec::new, |keyed, block| {
            keyed.clear();
            keyed.extend(block.iter().map(|side| {
                // the least point is the same for all
                let [_, middle, greatest] = side.face(mesh).map(u64::from);
                (middle << 32 | greatest, *side)
            }));
            keyed.sort_unstable();
            for (side, (_, sorted)) in block.iter_mut().zip(keyed) {
                *side = *sorted;
            }
        });
        Self::numbered(mesh, sides)
    }

    /// Faces from sides in the order of their faces.
    fn numbered(mesh: &TetrahedronMesh, sides: Vec<Side>) -> Self {
        let mut of_tetrahedra = vec![[0; 4]; mesh.tetrahedra().len()];
        let mut offsets = Vec::with_capacity(sides.len() / 2 + 1);
        let mut before = None;
        for (place, side) in sides.iter().enumerate() {
            let face = side.face(mesh);
            if before != Some(face) {
                offsets.push(place as u32);
                before = Some(face);
            }
            of_tetrahedra[side.tetrahedron()][side.opposite()] = offsets.len() as u32 - 1;
        }
        offsets.push(sides.len() as u32);
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
        &self.sides[self.offsets[face] as usize..self.offsets[face + 1] as usize]
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
        let other = if first.tetrahedron() == tetrahedron { second } else { first };
        let is_new = other.point(mesh) != mesh.tetrahedra()[tetrahedron][opposite];
        is_new.then_some(*other)
    }
}

/// All sides of faces, in the order of the faces' least points, and where those of each point
/// end: a counting sort.
fn by_least_point(mesh: &TetrahedronMesh) -> (Vec<Side>, Vec<u32>) {
    let all = || (0..mesh.tetrahedra().len()).flat_map(|t| [0, 1, 2, 3].map(|n| Side::new(t, n)));
    let least = |side: Side| {
        let corners = mesh.tetrahedra()[side.tetrahedron()];
        let others = [1, 2, 3].map(|step| corners[(side.opposite() + step) % 4]);
        others[0].min(others[1]).min(others[2]) as usize
    };
    let mut ends = vec![0_u32; mesh.points().len()];
    all().for_each(|side| ends[least(side)] += 1);
    let mut sum = 0;
    for end in &mut ends {
        (*end, sum) = (sum, sum + *end);
    }
    // where each begins becomes where it ends
    let mut sides = vec![Side(0); sum as usize];
    for side in all() {
        let end = &mut ends[least(side)];
        sides[*end as usize] = side;
        *end += 1;
    }
    (sides, ends)
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
        let sides = [Side::new(0, 0), Side::new(1, 1)];
        assert_eq!(faces.sides(shared as usize), sides);
        let alone = (0..7).filter(|&face| faces.sides(face).len() == 1).count();
        assert_eq!(alone, 6);
        assert_eq!(faces.beyond(&mesh, 0, 0), Some(sides[1]));
        assert_eq!(faces.beyond(&mesh, 1, 1), Some(sides[0]));
        assert_eq!(faces.beyond(&mesh, 0, 1), None);
        assert_eq!(sides.map(|side| side.point(&mesh)), [0, 4]);
        assert_eq!(sides.map(|side| side.face(&mesh)), [[1, 2, 3]; 2]);
        // 012, 013, 023, 123, 124, 134, 234
        assert_eq!(faces.of_tetrahedra(), [[3, 2, 1, 0], [5, 3, 4, 6]]);
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
