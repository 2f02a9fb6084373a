//! Monomials and their derivatives.

/// The monomials of a space.
#[derive(Clone, Debug)]
pub(super) struct Monomials<const N: usize> {
    powers: [[u8; 3]; N],
    /// Where the monomial with powers up to two each stands; `N` if there is none.
    positions: [[[usize; 3]; 3]; 3],
}

/// The highest power, and one more.
const POWERS: usize = 5;

/// Values and derivatives of the powers of each coordinate at one place: by coordinate,
/// order of the derivative, power.
#[derive(Clone, Copy, Debug)]
pub(super) struct Powers([[[f64; POWERS]; 3]; 3]);

impl Powers {
    /// The powers of three coordinates.
    pub fn new(at: &[f64; 3]) -> Self {
        Self(at.map(|x| {
            let powers = [1.0, x, x * x, x * x * x, x * x * x * x];
            [
                powers,
                [0.0, 1.0, 2.0 * x, 3.0 * powers[2], 4.0 * powers[3]],
                [0.0, 0.0, 2.0, 6.0 * x, 12.0 * powers[2]],
            ]
        }))
    }
}

impl<const N: usize> Monomials<N> {
    /// The monomials with these powers.
    pub fn new(powers: [[u8; 3]; N]) -> Self {
        let place = |wanted: [usize; 3]| {
            powers.iter().position(|powers| powers.map(usize::from) == wanted).unwrap_or(N)
        };
        let positions = [0, 1, 2].map(|i| [0, 1, 2].map(|j| [0, 1, 2].map(|k| place([i, j, k]))));
        Self { powers, positions }
    }

    /// All monomials, or their derivatives of the given orders by the three coordinates,
    /// at a place.
    pub fn derivatives(&self, at: &Powers, orders: [usize; 3]) -> [f64; N] {
        let [s, t, v] = [0, 1, 2].map(|axis| &at.0[axis][orders[axis]]);
        let mut derivatives = [0.0; N];
        for (derivative, powers) in derivatives.iter_mut().zip(&self.powers) {
            let [i, j, k] = powers.map(usize::from);
            *derivative = s[i] * t[j] * v[k];
        }
        derivatives
    }

    /// A derivative of a polynomial.
    pub fn derivative_of(&self, coefficients: &[f64; N], at: &Powers, orders: [usize; 3]) -> f64 {
        let monomials = self.derivatives(at, orders);
        coefficients.iter().zip(monomials).map(|(factor, monomial)| factor * monomial).sum()
    }

    /// Adds to the coefficient of a monomial with powers up to two each, all of which
    /// with total degree two or of a bilinear times a linear function every space has.
    pub fn add(&self, coefficients: &mut [f64; N], [i, j, k]: [usize; 3], term: f64) {
        if let Some(coefficient) = coefficients.get_mut(self.positions[i][j][k]) {
            *coefficient += term;
        }
    }
}

/// The derivative by one coordinate.
pub(super) const FIRST: [[usize; 3]; 3] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/// The sum of derivatives' orders.
pub(super) fn both(one: [usize; 3], other: [usize; 3]) -> [usize; 3] {
    [one[0] + other[0], one[1] + other[1], one[2] + other[2]]
}
