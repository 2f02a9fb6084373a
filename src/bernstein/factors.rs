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
    /// is zero, again written as a cubic. Inside the triangle it has the same sign.
    pub fn without_zero_sides(&self) -> TriangleCubic {
        let zero = self.zero_sides();
        let sides: Vec<usize> = (0..3).filter(|&side| zero[side]).collect();
        let cubic = |m: Exponents| self.coefficient(m);
        match sides[..] {
            [] => *self,
            [side] => elevated(&divided(&cubic, 3, side)),
            [first, second] => {
                let quadratic = divided(&cubic, 3, first);
                let linear = divided(&quadratic, 2, second);
                TriangleCubic::linear([linear([1, 0, 0]), linear([0, 1, 0]), linear([0, 0, 1])])
            }
            _ => TriangleCubic::new([self.coefficients[TriangleCubic::CENTRE]; 10]),
        }
    }
}

/// The coefficients, of one degree less, of a polynomial divided by the
/// barycentric coordinate `side`.
fn divided<'a>(
    polynomial: &'a dyn Fn(Exponents) -> f64,
    degree: usize,
    side: usize,
) -> impl Fn(Exponents) -> f64 + 'a {
    move |mut exponents| {
        exponents[side] += 1;
        polynomial(exponents) * degree as f64 / exponents[side] as f64
    }
}

/// A quadratic written as a cubic.
fn elevated(quadratic: &dyn Fn(Exponents) -> f64) -> TriangleCubic {
    TriangleCubic::from_coefficients(|exponents| {
        let term = |n: usize| {
            let mut lower = exponents;
            lower[n] -= 1;
            exponents[n] as f64 * quadratic(lower)
        };
        (0..3).filter(|&n| exponents[n] > 0).map(term).sum::<f64>() / 3.0
    })
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
            // three factors leave the constant 6 b_111; only its sign matters
            let scale = if sides == [true; 3] { 6.0 } else { 1.0 };
            prop_assert!((scale * product - cubic.value(&at)).abs() < 1e-14);
        }
    }
}
