//! The thesis' recursive search for an extreme of a cubic on a tetrahedron
//! (section 2.4.1, figure 2.26).
//!
//! The extreme of each face is sought as on a triangle; the four points found form a
//! smaller tetrahedron, in which the search goes on.

use super::extreme::{Attained, Extreme, best_of, recursive_extreme};
use crate::bernstein::{Barycentric4, TetrahedronCubic, vertices};

/// Recursive steps; each follows the extreme into a tetrahedron about half as large.
const MAX_LEVEL: usize = 5;

/// The extreme of `cubic` that the recursive search finds: a value that it attains.
pub fn recursive_extreme_in_tetrahedron(cubic: &TetrahedronCubic, which: Extreme) -> Attained<4> {
    search(cubic, &vertices(), which, 1)
}

fn search(
    cubic: &TetrahedronCubic,
    corners: &[Barycentric4; 4],
    which: Extreme,
    level: usize,
) -> Attained<4> {
    let here = cubic.sub_tetrahedron(corners);
    let on_faces = TetrahedronCubic::FACE_VERTICES.map(|face| {
        let found = recursive_extreme(&here.face(face), which);
        let at = [0, 1, 2, 3].map(|n| (0..3).map(|c| found.at[c] * corners[face[c]][n]).sum());
        Attained { value: found.value, at }
    });
    let best = best_of(&on_faces, which);
    let is_corner = on_faces.iter().all(|found| corners.contains(&found.at));
    if level == MAX_LEVEL || is_corner {
        return best;
    }
    let inner = search(cubic, &on_faces.map(|found| found.at), which, level + 1);
    best_of(&[best, inner], which)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn an_extreme_at_a_vertex() {
        let linear = TetrahedronCubic::linear([1.0, 2.0, 4.0, 3.0]);
        let found = recursive_extreme_in_tetrahedron(&linear, Extreme::Maximum);
        assert_eq!((found.value, found.at), (4.0, [0.0, 0.0, 1.0, 0.0]));
    }

    #[test]
    fn an_extreme_inside_is_found() {
        // highest at the centre; a little in the middles of the edges leads the search in
        let bump = TetrahedronCubic::from_coefficients(|exponents| match exponents.iter().max() {
            Some(1) => 1.0,
            Some(2) => 0.01,
            _ => 0.0,
        });
        let found = recursive_extreme_in_tetrahedron(&bump, Extreme::Maximum);
        let centre = bump.value(&[0.25; 4]);
        assert!(found.value > 0.97 * centre, "{found:?} against {centre}");
    }

    proptest! {
        #[test]
        fn attained(c in prop::collection::vec(-1.0..1.0f64, 20)) {
            let cubic = TetrahedronCubic::new(c.try_into().unwrap());
            let (low, high) = cubic.bounds();
            for which in [Extreme::Minimum, Extreme::Maximum] {
                let found = recursive_extreme_in_tetrahedron(&cubic, which);
                prop_assert!((cubic.value(&found.at) - found.value).abs() < 1e-12);
                prop_assert!(low - 1e-13 <= found.value && found.value <= high + 1e-13);
            }
        }
    }
}
