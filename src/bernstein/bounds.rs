//! Certain bounds of a polynomial.

/// The least and the greatest of some Bernstein coefficients: their polynomial lies
/// between the two.
pub(super) fn bounds(coefficients: &[f64]) -> (f64, f64) {
    // in four lanes: one after the other, each comparison would wait for the one before
    let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
    let mut meet = |lane: usize, coefficient: f64| {
        low[lane] = if coefficient < low[lane] { coefficient } else { low[lane] };
        high[lane] = if coefficient > high[lane] { coefficient } else { high[lane] };
    };
    let (fours, rest) = coefficients.as_chunks::<4>();
    for four in fours {
        four.iter().enumerate().for_each(|(lane, &coefficient)| meet(lane, coefficient));
    }
    rest.iter().enumerate().for_each(|(lane, &coefficient)| meet(lane, coefficient));
    let least = low.into_iter().fold(f64::INFINITY, f64::min);
    (least, high.into_iter().fold(f64::NEG_INFINITY, f64::max))
}

/// The range of what is in two ranges; of equal ends the first.
pub fn joined(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [if b[0] < a[0] { b[0] } else { a[0] }, if b[1] > a[1] { b[1] } else { a[1] }]
}

/// The least and the greatest value of a polynomial, or beyond, closer than the coefficients say:
/// from the range of those that lie on edges, and that of the others. The Bernstein polynomials of
/// these together are nowhere more than `share`, so that they count for no more than that. Computed
/// with rounding: a value may be beyond by a unit in the last place of the greatest coefficient.
pub fn value_bounds(on_edges: [f64; 2], others: [f64; 2], share: f64) -> [f64; 2] {
    let [least, greatest] = on_edges;
    // a difference of finite numbers need not be finite, that of parts of them is
    let below = if others[0] < least { share * least - share * others[0] } else { 0.0 };
    let above = if others[1] > greatest { share * others[1] - share * greatest } else { 0.0 };
    [least - below, greatest + above]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closer_bounds_by_hand() {
        assert_eq!(value_bounds([0.0, 4.0], [1.0, 3.0], 0.5), [0.0, 4.0]);
        assert_eq!(value_bounds([0.0, 4.0], [-2.0, 10.0], 0.5), [-1.0, 7.0]);
        let far = value_bounds([-1e308, -1e308], [-1e308, 1e308], 0.25);
        assert!(far[1].is_finite() && far[1] >= -0.5e308, "{far:?}");
    }
}
