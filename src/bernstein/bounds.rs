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
