//! The thesis' recursive search for an extreme of a cubic on a triangle
//! (section 2.3.1, figure 2.2).
//!
//! The extreme on each side is found exactly; if it is not at a vertex, the
//! three extreme points form a smaller triangle in which the search goes on.
//! The result is a value that the cubic *attains*, so it lies inside the certain
//! bounds; it may fall short of the true extreme.

use crate::bernstein::{Barycentric, SegmentCubic, TriangleCubic, between, vertices};

/// Which extreme is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    /// The least value.
    Minimum,
    /// The greatest value.
    Maximum,
}

impl Extreme {
    /// The more extreme of two values; of equal ones, as of zeros of either sign, the first.
    pub fn better(self, a: f64, b: f64) -> f64 {
        let is_better = match self {
            Extreme::Minimum => b < a,
            Extreme::Maximum => b > a,
        };
        if is_better { b } else { a }
    }

    /// The end of a range on this side.
    pub fn of(self, [low, high]: [f64; 2]) -> f64 {
        match self {
            Extreme::Minimum => low,
            Extreme::Maximum => high,
        }
    }
}

/// A value of a cubic and where it is attained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attained<const CORNERS: usize> {
    /// The value.
    pub value: f64,
    /// Where, in barycentric coordinates.
    pub at: [f64; CORNERS],
}

/// Recursive steps: each follows the extreme into a triangle about half as
/// large, which settles a cubic's extreme to a few digits.
const MAX_LEVEL: usize = 6;

/// The extreme of `cubic` that the recursive search finds.
pub fn recursive_extreme(cubic: &TriangleCubic, which: Extreme) -> Attained<3> {
    search(cubic, vertices(), which, 1)
}

fn search(
    cubic: &TriangleCubic,
    corners: [Barycentric; 3],
    which: Extreme,
    level: usize,
) -> Attained<3> {
    let sides = [0, 1, 2].map(|side| {
        let (start, end) = (corners[(side + 1) % 3], corners[(side + 2) % 3]);
        extreme_on_side(&cubic.restrict(&start, &end), &start, &end, which)
    });
    let best = best_of(&sides.map(|(found, _)| found), which);
    if level == MAX_LEVEL || !sides.iter().any(|(_, inside)| *inside) {
        return best;
    }
    let inner = search(cubic, sides.map(|(found, _)| found.at), which, level + 1);
    best_of(&[best, inner], which)
}

/// The extreme on a side, and whether it lies between the ends.
fn extreme_on_side(
    side: &SegmentCubic,
    start: &Barycentric,
    end: &Barycentric,
    which: Extreme,
) -> (Attained<3>, bool) {
    let mut best = (side.coefficients[0], 0.0);
    for t in side.critical_points().into_iter().chain([1.0]) {
        let value = side.value(t);
        if which.better(value, best.0) != best.0 {
            best = (value, t);
        }
    }
    let (value, t) = best;
    (Attained { value, at: between(start, end, t) }, t > 0.0 && t < 1.0)
}

/// The most extreme of some.
pub fn best_of<const CORNERS: usize>(
    found: &[Attained<CORNERS>],
    which: Extreme,
) -> Attained<CORNERS> {
    let mut best = found[0];
    for candidate in &found[1..] {
        if which.better(candidate.value, best.value) != best.value {
            best = *candidate;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn of_zeros_the_first_is_better() {
        for which in [Extreme::Minimum, Extreme::Maximum] {
            assert!(which.better(-0.0, 0.0).is_sign_negative());
            assert!(which.better(0.0, -0.0).is_sign_positive());
        }
    }

    #[test]
    fn an_extreme_at_a_vertex_ends_the_search() {
        let plane = TriangleCubic::linear([1.0, 2.0, 3.0]);
        let found = recursive_extreme(&plane, Extreme::Maximum);
        assert_eq!((found.value, found.at), (3.0, [0.0, 0.0, 1.0]));
    }

    #[test]
    fn a_bubble_is_found() {
        // 6 λ₀ λ₁ λ₂ minus a little at the middles of the sides, so that the
        // search goes inside: its maximum is 2/9 at the centroid, less a little
        let mut bubble = TriangleCubic::new([0.0; 10]);
        bubble.coefficients[TriangleCubic::CENTRE] = 1.0;
        for place in [1, 2, 3, 5, 7, 8] {
            bubble.coefficients[place] = 0.01;
        }
        let found = recursive_extreme(&bubble, Extreme::Maximum);
        let centre = bubble.value(&[1.0 / 3.0; 3]);
        assert!(found.value > 0.99 * centre, "{found:?} against {centre}");
    }

    proptest! {
        /// The value is attained where it is said to be, and lies in the bounds.
        #[test]
        fn attained(c in prop::array::uniform10(-1.0..1.0f64)) {
            let cubic = TriangleCubic::new(c);
            let (low, high) = cubic.bounds();
            for which in [Extreme::Minimum, Extreme::Maximum] {
                let found = recursive_extreme(&cubic, which);
                prop_assert!((cubic.value(&found.at) - found.value).abs() < 1e-13);
                prop_assert!(low - 1e-14 <= found.value && found.value <= high + 1e-14);
            }
        }
    }
}
