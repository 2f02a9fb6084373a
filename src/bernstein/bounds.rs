//! Certain bounds of a polynomial.

/// The least and the greatest of some Bernstein coefficients: their polynomial lies
/// between the two.
pub(super) fn bounds(coefficients: &[f64]) -> (f64, f64) {
    coefficients
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &c| (low.min(c), high.max(c)))
}
