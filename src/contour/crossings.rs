//! Where a cubic on a line crosses the level.

use arrayvec::ArrayVec;

use crate::bernstein::{SegmentCubic, Sign};

/// At most three crossings inside a segment and one at each end.
pub const MAX_CROSSINGS: usize = 5;

/// Where a cubic crosses zero, given the sides on which its ends lie.
///
/// Ascending. There are as many crossings as the sides demand: an even number for ends on
/// the same side, an odd one otherwise. Where an end lies on the level, and the
/// cubic leaves it on the other side, the crossing is at that end.
pub fn crossings(cubic: &SegmentCubic, start: Sign, end: Sign) -> ArrayVec<f64, MAX_CROSSINGS> {
    let roots = cubic.roots();
    let mut parameters = ArrayVec::new();
    let flat = roots.everywhere();
    let after_start = if flat { start } else { roots.after_start() };
    let before_end = if flat { start } else { roots.before_end() };
    if after_start != start {
        parameters.push(0.0);
    }
    parameters.extend(roots.crossings().filter(|&t| t > 0.0 && t < 1.0));
    if before_end != end {
        parameters.push(1.0);
    }
    parameters
}

#[cfg(test)]
mod tests {
    use super::*;
    use Sign::{Above, Below};
    use proptest::prelude::*;

    fn found(coefficients: [f64; 4], start: Sign, end: Sign) -> Vec<f64> {
        crossings(&SegmentCubic::new(coefficients), start, end).to_vec()
    }

    #[test]
    fn an_end_on_the_level_counts_as_above() {
        // down from the level: the crossing is at the end
        assert_eq!(found([0.0, -1.0, -1.0, -1.0], Above, Below), [0.0]);
        // up from the level: no crossing
        assert!(found([0.0, 1.0, 1.0, 1.0], Above, Above).is_empty());
        // down between two ends on the level
        assert_eq!(found([0.0, -1.0, -1.0, 0.0], Above, Above), [0.0, 1.0]);
    }

    #[test]
    fn a_flat_segment_follows_its_ends() {
        assert!(found([0.0; 4], Above, Above).is_empty());
        assert_eq!(found([0.0; 4], Above, Below), [1.0]);
    }

    #[test]
    fn touches_are_no_crossings() {
        assert!(found([1.0, -1.0 / 3.0, -1.0 / 3.0, 1.0], Above, Above).is_empty());
    }

    proptest! {
        #[test]
        fn the_number_fits_the_sides(c in prop::array::uniform4(-2..3i32)) {
            let cubic = SegmentCubic::new(c.map(f64::from));
            for start in [Above, Below] {
                for end in [Above, Below] {
                    let fits = |value: f64, sign| value == 0.0 || Sign::of(value) == sign;
                    if fits(cubic.coefficients[0], start) && fits(cubic.coefficients[3], end) {
                        let count = crossings(&cubic, start, end).len();
                        prop_assert_eq!(count % 2 == 1, start != end);
                    }
                }
            }
        }
    }
}
