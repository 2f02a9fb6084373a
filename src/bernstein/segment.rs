//! Cubic polynomials on a segment.

use arrayvec::ArrayVec;

/// A cubic polynomial on the unit segment, by its four Bernstein coefficients.
///
/// `p(t) = Σ cᵢ C(3,i) (1−t)³⁻ⁱ tⁱ` for `t` in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentCubic {
    /// Bernstein coefficients, from `t = 0` to `t = 1`.
    pub coefficients: [f64; 4],
}

impl SegmentCubic {
    /// The cubic with the given Bernstein coefficients.
    pub fn new(coefficients: [f64; 4]) -> Self {
        Self { coefficients }
    }

    /// The cubic with values `u0`, `u1` and derivatives `d0`, `d1` at the ends.
    pub fn hermite(u0: f64, d0: f64, u1: f64, d1: f64) -> Self {
        Self::new([u0, u0 + d0 / 3.0, u1 - d1 / 3.0, u1])
    }

    /// The value at `t`, by de Casteljau's algorithm.
    pub fn value(&self, t: f64) -> f64 {
        let [a, b, c, d] = self.coefficients;
        let s = 1.0 - t;
        let (ab, bc, cd) = (s * a + t * b, s * b + t * c, s * c + t * d);
        let (abc, bcd) = (s * ab + t * bc, s * bc + t * cd);
        s * abc + t * bcd
    }

    /// The first derivative at `t`.
    pub fn derivative(&self, t: f64) -> f64 {
        let [a, b, c] = self.differences();
        let s = 1.0 - t;
        3.0 * (s * (s * a + t * b) + t * (s * b + t * c))
    }

    /// The second derivative at `t`.
    pub fn second_derivative(&self, t: f64) -> f64 {
        let [a, b, c] = self.differences();
        6.0 * ((1.0 - t) * (b - a) + t * (c - b))
    }

    /// Differences of neighbouring coefficients: a third of the Bernstein
    /// coefficients of the derivative.
    pub(super) fn differences(&self) -> [f64; 3] {
        let [a, b, c, d] = self.coefficients;
        [b - a, c - b, d - c]
    }

    /// The two cubics left and right of `t`, each on its own unit segment.
    pub fn split(&self, t: f64) -> (Self, Self) {
        let [a, b, c, d] = self.coefficients;
        let s = 1.0 - t;
        let (ab, bc, cd) = (s * a + t * b, s * b + t * c, s * c + t * d);
        let (abc, bcd) = (s * ab + t * bc, s * bc + t * cd);
        let middle = s * abc + t * bcd;
        (Self::new([a, ab, abc, middle]), Self::new([middle, bcd, cd, d]))
    }

    /// The same polynomial with its ends exchanged.
    pub fn reversed(&self) -> Self {
        let [a, b, c, d] = self.coefficients;
        Self::new([d, c, b, a])
    }

    /// The polynomial minus a constant.
    pub fn minus(&self, constant: f64) -> Self {
        Self::new(self.coefficients.map(|c| c - constant))
    }

    /// Certain bounds: the least and the greatest coefficient.
    pub fn bounds(&self) -> (f64, f64) {
        let [a, b, c, d] = self.coefficients;
        (a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }

    /// Places in the open segment where the derivative is zero, ascending.
    ///
    /// At most two. Where the polynomial is constant there are none.
    pub fn critical_points(&self) -> ArrayVec<f64, 2> {
        let [a, b, c] = self.differences();
        quadratic_roots_inside(a, b, c)
    }
}

/// Roots in `(0, 1)` of the quadratic with Bernstein coefficients `a, b, c`,
/// ascending and without repeats.
///
/// With `t = r / (1 + r)` the quadratic becomes `a + 2 b r + c r²`, and the roots
/// inside are those with `r > 0`. The two are taken as `q / c` and `a / q`, which
/// avoids the cancellation of the textbook formula.
fn quadratic_roots_inside(a: f64, b: f64, c: f64) -> ArrayVec<f64, 2> {
    let discriminant = b * b - a * c;
    let mut roots = ArrayVec::new();
    if discriminant < 0.0 {
        return roots;
    }
    let q = -(b + discriminant.sqrt().copysign(b));
    for (numerator, denominator) in [(q, c), (a, q)] {
        let same_sign = numerator * denominator.signum() > 0.0 && denominator != 0.0;
        let t = numerator / (numerator + denominator);
        if same_sign && t > 0.0 && t < 1.0 && !roots.contains(&t) {
            roots.push(t);
        }
    }
    roots.sort_unstable_by(f64::total_cmp);
    roots
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn halves_are_the_whole(c in prop::array::uniform4(-1.0..1.0f64), t in 0.0..1.0f64, s in 0.0..1.0f64) {
            let whole = SegmentCubic::new(c);
            let (left, right) = whole.split(t);
            prop_assert!((left.value(s) - whole.value(s * t)).abs() < 1e-14);
            prop_assert!((right.value(s) - whole.value(t + s * (1.0 - t))).abs() < 1e-14);
        }

        #[test]
        fn the_slope_is_zero_at_critical_points(c in prop::array::uniform4(-1.0..1.0f64)) {
            let cubic = SegmentCubic::new(c);
            let critical = cubic.critical_points();
            for &t in &critical {
                prop_assert!(cubic.derivative(t).abs() < 1e-13);
            }
            // between them the slope keeps its sign
            let mut stations = vec![0.0];
            stations.extend_from_slice(&critical);
            stations.push(1.0);
            for pair in stations.windows(2) {
                let middle = cubic.derivative(0.5 * (pair[0] + pair[1]));
                for i in 1..20 {
                    let slope = cubic.derivative(pair[0] + (pair[1] - pair[0]) * f64::from(i) / 20.0);
                    prop_assert!(slope * middle > 0.0);
                }
            }
        }
    }

    #[test]
    fn hermite_data_are_met() {
        let cubic = SegmentCubic::hermite(1.0, -2.0, 3.0, 4.0);
        assert_eq!((cubic.value(0.0), cubic.value(1.0)), (1.0, 3.0));
        assert!((cubic.derivative(0.0) + 2.0).abs() < 1e-15);
        assert!((cubic.derivative(1.0) - 4.0).abs() < 1e-15);
    }
}
