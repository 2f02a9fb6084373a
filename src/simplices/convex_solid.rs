//! Convex solids cut into tetrahedra from their least corner.
//!
//! Every face is cut by the diagonals from its own least corner, and the solid by
//! joining the least of all its corners to the triangles of the faces that do not
//! hold it. The faces that hold it are then cut from it as well, so two solids
//! agree on a face that they share, whatever their shapes. For pyramids, prisms
//! and hexahedra this is the rule of J. Dompierre, P. Labbé, M.-G. Vallet,
//! R. Camarero, *How to subdivide pyramids, prisms and hexahedra into tetrahedra*,
//! 8th International Meshing Roundtable (1999) 195-204; in general it is called a
//! pulling triangulation.

/// A point of a cell: of two points, the one of lower rank comes first, then the
/// one of lower number. As the rank is the same in all cells that share the point,
/// these agree on the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Key(u64);

impl Key {
    /// The key of a point.
    pub fn new(rank: u8, point: u32) -> Self {
        Self(u64::from(rank) << 32 | u64::from(point))
    }

    /// The point's number.
    pub fn point(self) -> u32 {
        // the lower half
        self.0 as u32
    }
}

/// The faces of a convex solid: loops of corners, counter-clockwise from outside.
#[derive(Debug, Default)]
pub struct ConvexSolid {
    corners: Vec<Key>,
    /// Where each face ends in `corners`.
    ends: Vec<usize>,
}

impl ConvexSolid {
    /// Takes all faces away.
    pub fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }

    /// Adds a face. Corners that are named twice in a row count once, and a face
    /// with fewer than three corners left is none: that is how solvers write a
    /// wedge as a hexahedron.
    pub fn push_face(&mut self, face: impl IntoIterator<Item = Key>) {
        let start = self.corners.len();
        for corner in face {
            push_corner(&mut self.corners, start, corner);
        }
        close_loop(&mut self.corners, start);
        if self.corners.len() - start < 3 {
            self.corners.truncate(start);
        } else {
            self.ends.push(self.corners.len());
        }
    }

    /// Adds the solid's tetrahedra, positive where the solid is convex.
    pub fn cut(&self, tetrahedra: &mut Vec<[u32; 4]>) {
        let Some(&apex) = self.corners.iter().min() else { return };
        let mut start = 0;
        for &end in &self.ends {
            let face = &self.corners[start..end];
            start = end;
            if !face.contains(&apex) {
                fan(face, |a, b, c| tetrahedra.push([apex, a, b, c].map(Key::point)));
            }
        }
    }
}

/// Adds a corner to the loop that begins at `start`, without repeats and spikes
/// (from a corner to the next and straight back).
fn push_corner(corners: &mut Vec<Key>, start: usize, corner: Key) {
    let same = |place: Option<&Key>| place.is_some_and(|key| key.point() == corner.point());
    if same(corners[start..].last()) {
        return;
    }
    if corners.len() >= start + 2 && same(corners.get(corners.len() - 2)) {
        corners.pop();
        return;
    }
    corners.push(corner);
}

/// Removes repeats and spikes where the loop's end meets its begin.
fn close_loop(corners: &mut Vec<Key>, start: usize) {
    while let [first, .., last] = corners[start..] {
        let length = corners.len() - start;
        let same = |a: Key, b: Key| a.point() == b.point();
        if same(first, last) || length >= 3 && same(first, corners[start + length - 2]) {
            corners.pop();
        } else if length >= 3 && same(last, corners[start + 1]) {
            corners.remove(start);
        } else {
            return;
        }
    }
}

/// The triangles of a convex polygon, all from its least corner.
pub fn fan(face: &[Key], mut triangle: impl FnMut(Key, Key, Key)) {
    let Some(least) = (0..face.len()).min_by_key(|&place| face[place]) else { return };
    let corner = |step: usize| face[(least + step) % face.len()];
    for step in 1..face.len() - 1 {
        triangle(corner(0), corner(step), corner(step + 1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(points: &[u32]) -> impl Iterator<Item = Key> + '_ {
        points.iter().map(|&point| Key::new(0, point))
    }

    fn tetrahedra(faces: &[&[u32]]) -> Vec<[u32; 4]> {
        let mut solid = ConvexSolid::default();
        faces.iter().for_each(|face| solid.push_face(keys(face)));
        let mut tetrahedra = Vec::new();
        solid.cut(&mut tetrahedra);
        tetrahedra
    }

    #[test]
    fn a_pyramid_by_hand() {
        let faces: [&[u32]; 5] = [&[3, 9, 7, 5], &[5, 7, 1], &[7, 9, 1], &[9, 3, 1], &[3, 5, 1]];
        assert_eq!(tetrahedra(&faces), [[1, 3, 9, 7], [1, 3, 7, 5]]);
        let faces: [&[u32]; 5] = [&[3, 9, 7, 5], &[5, 7, 8], &[7, 9, 8], &[9, 3, 8], &[3, 5, 8]];
        assert_eq!(tetrahedra(&faces), [[3, 5, 7, 8], [3, 7, 9, 8]]);
    }

    #[test]
    fn rank_comes_before_number() {
        let mut solid = ConvexSolid::default();
        let key = |point: u32| Key::new(u8::from(point != 3), point);
        for face in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
            solid.push_face(face.map(key));
        }
        let mut tetrahedra = Vec::new();
        solid.cut(&mut tetrahedra);
        assert_eq!(tetrahedra, [[3, 0, 2, 1]]);
    }

    #[test]
    fn repeats_and_spikes_vanish() {
        let mut solid = ConvexSolid::default();
        let gone: [&[u32]; 8] = [
            &[],
            &[1],
            &[1, 1, 2, 2],
            &[1, 2, 1, 3],
            &[3, 1, 2, 1],
            &[1, 2, 3, 2],
            &[2, 1, 2, 1],
            &[1, 2, 3, 3, 2, 1],
        ];
        for face in gone {
            solid.push_face(keys(face));
            assert!(solid.ends.is_empty() && solid.corners.is_empty(), "{face:?}");
        }
        for face in [[1, 2, 2, 3], [1, 1, 2, 3], [1, 2, 3, 1]] {
            solid.clear();
            solid.push_face(keys(&face));
            let points: Vec<u32> = solid.corners.iter().map(|key| key.point()).collect();
            assert_eq!(points, [1, 2, 3]);
        }
    }
}
