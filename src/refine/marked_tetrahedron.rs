//! A tetrahedron that knows how it is to be bisected.
//!
//! D. N. Arnold, A. Mukherjee, L. Pouly, Locally adapted tetrahedral meshes using bisection
//! (2000). Each face has a *marked edge*, and one edge is marked in both its faces: the
//! *refinement edge*, at which the tetrahedron is bisected. The marks of the halves follow from
//! those of the whole, so that all that come of one tetrahedron have a bounded number of shapes.

/// The marks of a tetrahedron, by its corners.
///
/// The marked edge of a face is told by its apex, the corner of the face that is not on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TetrahedronMarks {
    /// The apexes of the faces opposite the corners.
    apexes: [u8; 4],
    /// A corner opposite a face that has the refinement edge; its apex is opposite the other.
    opposite: u8,
    /// The paper's flag: the parent's marks lay in a face, and its own parent's did not count.
    flag: bool,
}

/// A tetrahedron that can be bisected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MarkedTetrahedron {
    /// Its points.
    pub corners: [u32; 4],
    /// How it is bisected.
    pub marks: TetrahedronMarks,
}

impl TetrahedronMarks {
    /// The first marks: in each face its greatest edge, by a rank that differs for all edges
    /// and is the same in all tetrahedra. `rank` is that of the edge between two corners.
    pub fn first<R: Ord>(rank: impl Fn(usize, usize) -> R) -> Self {
        let apexes = std::array::from_fn(|face| {
            let apexes = (0..4).filter(|&apex| apex != face);
            let greatest = apexes.max_by_key(|&apex| {
                let [i, j] = others(face, apex);
                rank(i, j)
            });
            greatest.unwrap_or(0) as u8
        });
        // the greatest edge of all is that of both its faces
        let faces = (0..4_u8).max_by_key(|&face| {
            let [i, j] = others(usize::from(face), usize::from(apexes[usize::from(face)]));
            rank(i, j)
        });
        Self { apexes, opposite: faces.unwrap_or(0), flag: false }
    }

    /// Marks from a number that [`Self::code`] made, if they are possible.
    pub fn of_code(code: u16) -> Option<Self> {
        let apexes = std::array::from_fn(|face| (code >> (2 * face)) as u8 & 3);
        let (opposite, flag) = ((code >> 8) as u8 & 3, code >> 10 & 1 == 1);
        let marks = Self { apexes, opposite, flag };
        let proper = (0..4).all(|face| usize::from(apexes[face]) != face);
        let other = apexes[usize::from(opposite)];
        (proper && code < 1 << 11 && apexes[usize::from(other)] == opposite).then_some(marks)
    }

    /// The marks as a number.
    pub fn code(&self) -> u16 {
        let apexes = self.apexes.iter().rev().fold(0, |code, &apex| code << 2 | u16::from(apex));
        apexes | u16::from(self.opposite) << 8 | u16::from(self.flag) << 10
    }

    /// The corners of the refinement edge, ascending.
    pub fn refinement_edge(&self) -> [usize; 2] {
        others(usize::from(self.opposite), usize::from(self.apexes[usize::from(self.opposite)]))
    }

    /// The corners of the marked edge of the face opposite a corner, ascending.
    pub fn marked_edge(&self, face: usize) -> [usize; 2] {
        others(face, usize::from(self.apexes[face]))
    }

    /// Whether all marked edges lie in one face: the paper's type P.
    fn is_planar(&self) -> bool {
        let [i, j] = self.refinement_edge();
        // neither face may have the edge opposite the refinement edge marked
        self.apexes[i] == self.apexes[j]
    }

    /// The marks of the half in which the middle of the refinement edge has replaced a corner.
    fn half(&self, replaced: usize) -> Self {
        let [i, j] = self.refinement_edge();
        let kept = i + j - replaced;
        // faces cut in two: the edge opposite the new point; the face that was whole: as it was
        let mut apexes = [replaced as u8; 4];
        apexes[replaced] = self.apexes[replaced];
        // the new face, which both halves have
        if self.is_planar() && self.flag {
            apexes[kept] = self.apexes[replaced];
        }
        Self { apexes, opposite: replaced as u8, flag: self.is_planar() && !self.flag }
    }
}

impl MarkedTetrahedron {
    /// The points of the refinement edge, ascending.
    pub fn refinement_edge(&self) -> [u32; 2] {
        let [a, b] = self.marks.refinement_edge().map(|corner| self.corners[corner]);
        [a.min(b), a.max(b)]
    }

    /// The two halves, turned as the whole is. `middle`: the middle of the refinement edge.
    pub fn bisect(&self, middle: u32) -> [Self; 2] {
        self.marks.refinement_edge().map(|replaced| {
            let mut corners = self.corners;
            corners[replaced] = middle;
            Self { corners, marks: self.marks.half(replaced) }
        })
    }
}

/// The two other corners, ascending.
fn others(a: usize, b: usize) -> [usize; 2] {
    let mut rest = (0..4).filter(|&corner| corner != a && corner != b);
    [rest.next().unwrap_or(0), rest.next().unwrap_or(0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_by_hand() {
        // longest first: 01, 02, 12, 03, 13, 23: all marks in the face 012
        let ranks = [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3]];
        let rank = |i: usize, j: usize| {
            std::cmp::Reverse(ranks.iter().position(|edge| *edge == [i.min(j), i.max(j)]))
        };
        let marks = TetrahedronMarks::first(rank);
        assert_eq!(marks.refinement_edge(), [0, 1]);
        assert_eq!(
            [0, 1, 2, 3].map(|face| marks.marked_edge(face)),
            [[1, 2], [0, 2], [0, 1], [0, 1]]
        );
        assert!(marks.is_planar() && !marks.flag);
        let [one, other] = MarkedTetrahedron { corners: [10, 11, 12, 13], marks }.bisect(14);
        assert_eq!((one.corners, other.corners), ([14, 11, 12, 13], [10, 14, 12, 13]));
        assert_eq!((one.refinement_edge(), other.refinement_edge()), ([11, 12], [10, 12]));
        assert!(one.marks.flag && other.marks.flag);
        // the new face 14-12-13: unflagged, the edge opposite the new point
        assert_eq!(one.marks.marked_edge(1), [2, 3]);
        assert_eq!(other.marks.marked_edge(0), [2, 3]);
    }

    #[test]
    fn codes_return() {
        let marks = TetrahedronMarks::first(|i, j| (i + 1) * (j + 1));
        for corner in marks.refinement_edge() {
            let half = marks.half(corner);
            assert_eq!(TetrahedronMarks::of_code(half.code()), Some(half));
        }
        assert_eq!(TetrahedronMarks::of_code(0), None);
        assert_eq!(TetrahedronMarks::of_code(u16::MAX), None);
        assert!((0..1 << 11).filter_map(TetrahedronMarks::of_code).count() > 100);
    }
}
