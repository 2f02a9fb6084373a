//! The functions that span the spaces of quadratic elements.

use super::reference::Place;

/// A function on a reference cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// x to the first power, times y to the second, times z to the third.
    Powers([u8; 3]),
    /// x y (1 - x - y), zero on the sides of the triangle.
    Bubble,
    /// x to the first power, times y to the second, over 1 - z: with these, the
    /// faces of a pyramid have all quadratics on them and no more, as neighbours
    /// expect. Source: G. Bedrosian, *Shape functions and integration formulas for
    /// three-dimensional finite element analysis*, Int. J. Numer. Methods Eng. 35
    /// (1992) 95-108.
    OverHeight([u8; 2]),
}

impl Term {
    /// The value at a place.
    pub fn value(self, [x, y, z]: Place) -> f64 {
        match self {
            Self::Powers([a, b, c]) => power(x, a) * power(y, b) * power(z, c),
            Self::Bubble => x * y * (1.0 - x - y),
            // at the apex x and y vanish faster than the height
            Self::OverHeight(_) if z == 1.0 => 0.0,
            Self::OverHeight([a, b]) => power(x, a) * power(y, b) / (1.0 - z),
        }
    }

    /// The derivatives by x, y and z at a place. A pyramid's apex has none for some
    /// terms: there they are those along its axis, zero.
    pub fn derivatives(self, [x, y, z]: Place) -> [f64; 3] {
        match self {
            Self::Powers([a, b, c]) => [
                slope(x, a) * power(y, b) * power(z, c),
                power(x, a) * slope(y, b) * power(z, c),
                power(x, a) * power(y, b) * slope(z, c),
            ],
            Self::Bubble => [y * (1.0 - 2.0 * x - y), x * (1.0 - x - 2.0 * y), 0.0],
            Self::OverHeight(_) if z == 1.0 => [0.0; 3],
            Self::OverHeight([a, b]) => {
                let height = 1.0 - z;
                [
                    slope(x, a) * power(y, b) / height,
                    power(x, a) * slope(y, b) / height,
                    power(x, a) * power(y, b) / (height * height),
                ]
            }
        }
    }
}

fn power(x: f64, exponent: u8) -> f64 {
    x.powi(exponent.into())
}

/// The derivative of a power.
fn slope(x: f64, exponent: u8) -> f64 {
    if exponent == 0 { 0.0 } else { f64::from(exponent) * power(x, exponent - 1) }
}
