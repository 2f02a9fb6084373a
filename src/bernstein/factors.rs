//! Division of a cubic by the sides on which it is zero.
//!
//! A cubic that is zero on a side of its triangle is the product of that side's
//! barycentric coordinate and a quadratic. The quadratic's zeros are those that
//! the cubic has beside the side itself.

use super::triangle::TriangleCubic;

/// Exponents of the three barycentric coordinates.
type Exponents = [usize; 3];

impl TriangleCubic {
    /// Which sides this cubic is zero on; side `n` is opposite vertex `n`.
    pub fn zero_sides(&self) -> [bool; 3] {
        [0, 1, 2].map(|side| self.edge(side).coefficients == [0.0; 4])
    }

    /// This cubic divided by the barycentric coordinates of the sides on which it
    /// is zero, as often as it can be, and again written as a cubic. Inside the
    /// triangle it has the same sign.
    pub fn without_zero_sides(&self) -> TriangleCubic {
        let mut polynomial = Polynomial { degree: 3, coefficients: *self };
        while let Some(side) = polynomial.zero_side() {
            polynomial = polynomial.divided(side);
        }
        polynomial.elevated()
    }
}

/// A polynomial of degree three or less. The coefficient with exponents `[i, j, k]`
/// stands where a cubic has the one with exponents `[3 - j - k, j, k]`.
struct Polynomial {
    degree: usize,
    coefficients: TriangleCubic,
}

impl Polynomial {
    fn coefficient(&self, [_, j, k]: Exponents) -> f64 {
        self.coefficients.coefficient([3 - j - k, j, k])
    }

    /// A polynomial with the coefficients given by a function of their exponents.
    fn new(degree: usize, coefficient: impl Fn(Exponents) -> f64) -> Self {
        let coefficients = TriangleCubic::from_coefficients(|[_, j, k]| {
            if j + k <= degree { coefficient([degree - j - k, j, k]) } else { 0.0 }
        });
        Self { degree, coefficients }
    }

    /// A side on which the polynomial is zero; none if it is zero everywhere, or
    /// constant.
    fn zero_side(&self) -> Option<usize> {
        let zero = |side: usize| {
            let all = (0..=self.degree).flat_map(|j| (0..=self.degree - j).map(move |k| (j, k)));
            let mut on_side = all.map(|(j, k)| [self.degree - j - k, j, k]);
            on_side.all(|exponents| exponents[side] > 0 || self.coefficient(exponents) == 0.0)
        };
        let everywhere = self.coefficients.coefficients == [0.0; 10];
        (0..3).find(|&side| self.degree > 0 && !everywhere && zero(side))
    }

    /// The polynomial divided by the barycentric coordinate of a side on which it
    /// is zero.
    fn divided(&self, side: usize) -> Self {
        Self::new(self.degree - 1, |mut exponents| {
            exponents[side] += 1;
            self.coefficient(exponents) * self.degree as f64 / exponents[side] as f64
        })
    }

    /// The polynomial written as a cubic.
    fn elevated(self) -> TriangleCubic {
        let mut polynomial = self;
        while polynomial.degree < 3 {
            let degree = polynomial.degree + 1;
            polynomial = Self::new(degree, |exponents| {
                let term = |n: usize| {
                    let mut lower = exponents;
                    lower[n] -= 1;
                    exponents[n] as f64 * polynomial.coefficient(lower)
                };
                (0..3).filter(|&n| exponents[n] > 0).map(term).sum::<f64>() / degree as f64
            });
        }
        polynomial.coefficients
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A cubic that is zero on the given sides.
    fn zero_on(coefficients: [f64; 10], sides: [bool; 3]) -> TriangleCubic {
        let whole = TriangleCubic::new(coefficients);
        TriangleCubic::from_coefficients(|m| {
            let on_zero_side = (0..3).any(|side| sides[side] && m[side] == 0);
            if on_zero_side { 0.0 } else { whole.coefficient(m) }
        })
    }

    proptest! {
        #[test]
        fn the_product_is_the_cubic(
            c in prop::array::uniform10(0.1..1.0f64),
            sides in prop::array::uniform3(prop::bool::ANY),
            s in 0.0..0.5f64, t in 0.0..0.5f64,
        ) {
            let cubic = zero_on(c, sides);
            prop_assert_eq!(cubic.zero_sides(), sides);
            let at = [1.0 - s - t, s, t];
            let mut product = cubic.without_zero_sides().value(&at);
            for side in 0..3 {
                if sides[side] {
                    product *= at[side];
                }
            }
            prop_assert!((product - cubic.value(&at)).abs() < 1e-14);
        }

        /// λ₀² ℓ and λ₀² λ₁: sides that are zero twice.
        #[test]
        fn double_sides(c in prop::array::uniform3(0.1..1.0f64), s in 0.0..0.5f64, t in 0.0..0.5f64) {
            let at = [1.0 - s - t, s, t];
            // 3 b_ijk of λ₀² (c₀ λ₀ + c₁ λ₁ + c₂ λ₂)
            let cubic = TriangleCubic::from_coefficients(|m| match m {
                [3, 0, 0] => c[0],
                [2, 1, 0] => c[1] / 3.0,
                [2, 0, 1] => c[2] / 3.0,
                _ => 0.0,
            });
            let linear = c[0] * at[0] + c[1] * at[1] + c[2] * at[2];
            prop_assert!((cubic.without_zero_sides().value(&at) - linear).abs() < 1e-14);
            let cubic = TriangleCubic::from_coefficients(|m| if m == [2, 1, 0] { c[1] / 3.0 } else { 0.0 });
            prop_assert!((cubic.without_zero_sides().value(&at) - c[1]).abs() < 1e-14);
        }
    }
}
