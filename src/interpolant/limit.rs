//! How far neighbours may move the coefficient amid a triangle.
//!
//! The neighbours' data say more of it than the triangle's own only where the solution is
//! resolved. There the correction is small beside what the triangle's own nine coefficients
//! differ by: of fourth order beside first. So one that is greater than their spread is no
//! knowledge, and is cut to it. Three things follow:
//!
//! - what is constant stays constant: a plateau, and a wall on which the solution is fixed;
//! - a wild gradient beyond an edge makes no hill in the triangle;
//! - the range of a triangle's cubic is bounded by its own data, before a neighbour is asked.
//!
//! A cubic is reproduced, unless its own coefficient amid a triangle is farther from the
//! quadratic's than that: multiples of `λ₀ λ₁ λ₂` are, whose other nine are zero.
//!
//! Source: ours.

use super::hermite::beside;
use crate::field::Field;
use crate::mesh::Vector;

/// The correction of the coefficient amid the triangle between three points, no greater than the
/// spread there; zero if there is none that is finite. The same for any order of the points.
pub(super) fn limited(
    correction: f64,
    points: &[u32; 3],
    positions: &[Vector],
    field: &Field,
) -> f64 {
    // most are within that of the vertices alone, which is no more
    let [a, b, c] = points.map(|point| field.values[point as usize]);
    if correction.abs() <= a.max(b).max(c) - a.min(b).min(c) {
        return correction;
    }
    cut(correction, spread(points, positions, field))
}

/// The spread of the nine coefficients that values and gradients give on the triangle between
/// three points: the greatest less the least.
fn spread(points: &[u32; 3], positions: &[Vector], field: &Field) -> f64 {
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut include = |coefficient: f64| {
        least = least.min(coefficient);
        greatest = greatest.max(coefficient);
    };
    for &from in points {
        let from = from as usize;
        include(field.values[from]);
        for &to in points {
            if to as usize != from {
                let edge = positions[to as usize] - positions[from];
                include(beside(field.values[from], &field.gradients[from], &edge));
            }
        }
    }
    greatest - least
}

/// The correction, no greater than the spread; zero if there is none that is finite.
fn cut(correction: f64, spread: f64) -> f64 {
    if correction.abs() <= spread {
        correction
    } else if spread.is_finite() && !correction.is_nan() {
        spread.copysign(correction)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_by_hand() {
        assert_eq!(cut(0.5, 2.0), 0.5);
        assert_eq!(cut(-3.0, 2.0), -2.0);
        assert_eq!(cut(f64::INFINITY, 2.0), 2.0);
        assert_eq!(cut(1.0, 0.0), 0.0);
        assert_eq!(cut(f64::NAN, 2.0), 0.0);
        assert_eq!(cut(1.0, f64::NAN), 0.0);
    }

    #[test]
    fn spreads_by_hand() {
        let points = [Vector::zeros(), Vector::new(0.3, 0.4, 0.0), Vector::z()];
        let across = Vector::new(4.0, -3.0, 0.0);
        let of = |values: [f64; 3], gradients: [Vector; 3]| {
            spread(&[0, 1, 2], &points, &Field { values: &values, gradients: &gradients })
        };
        // a plateau, and a wall that fluid passes by
        assert_eq!(of([0.0; 3], [Vector::zeros(); 3]), 0.0);
        assert!(of([2.0; 3], [across, across * 5.0, -across]) < 1e-14);
        // the coefficient next to point 2, toward 0 and toward 1
        assert_eq!(of([2.0; 3], [across, across, Vector::z() * 3.0]), 1.0);
        assert_eq!(of([2.0, 2.0, 2.5], [Vector::zeros(); 3]), 0.5);
        // more than the vertices differ by, and less than the others do
        let (values, gradients) = ([2.0, 2.0, 2.25], [across, across, Vector::z() * 3.0]);
        let field = Field { values: &values, gradients: &gradients };
        for (correction, expected) in [(0.2, 0.2), (-0.7, -0.7), (1.5, 1.0), (-9.0, -1.0)] {
            assert_eq!(limited(correction, &[0, 1, 2], &points, &field), expected);
        }
        assert_eq!(limited(f64::NAN, &[0, 1, 2], &points, &field), 0.0);
    }
}
