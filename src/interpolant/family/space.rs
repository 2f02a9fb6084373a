//! A space of polynomials, with the points where the PDE is to hold, as data.

use super::shape::Shape;

/// The space of an interpolant: on cells with so many corners, polynomials of so many
/// coefficients.
///
/// Its monomials are `sⁱ tʲ vᵏ` in the coordinates of the cell's enclosing box, from 0 to
/// 1 (thesis, eq. 1.3), with `i, j, k ≤ each` and `i + j + k ≤ total`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Space<const CORNERS: usize, const N: usize> {
    /// The thesis' name.
    pub name: &'static str,
    /// The cells.
    pub shape: Shape,
    /// The highest power of each coordinate.
    pub each: u8,
    /// The highest sum of powers.
    pub total: u8,
    /// Where the PDE holds, as weights of the corners: these points and those that they
    /// become if corners change places.
    pub points: &'static [[f64; CORNERS]],
}

impl<const CORNERS: usize, const N: usize> Space<CORNERS, N> {
    /// A space.
    ///
    /// # Panics
    /// Unless it has `N` monomials; the spaces of this crate are constants, so a wrong
    /// number is an error of the compiler.
    pub const fn new(
        name: &'static str,
        shape: Shape,
        each: u8,
        total: u8,
        points: &'static [[f64; CORNERS]],
    ) -> Self {
        let space = Self { name, shape, each, total, points };
        assert!(space.monomials().1 == N);
        space
    }

    /// The powers `[i, j, k]` of the monomials, and how many there are.
    pub(super) const fn monomials(&self) -> ([[u8; 3]; N], usize) {
        let (mut monomials, mut count) = ([[0; 3]; N], 0);
        let each = self.each + 1;
        let last = if self.shape.dimension() == 3 { each } else { 1 };
        let mut number = 0;
        while number < each as u16 * each as u16 * last as u16 {
            let (i, rest) = (number % each as u16, number / each as u16);
            let (j, k) = (rest % each as u16, rest / each as u16);
            if i + j + k <= self.total as u16 {
                if count < N {
                    monomials[count] = [i as u8, j as u8, k as u8];
                }
                count += 1;
            }
            number += 1;
        }
        (monomials, count)
    }

    /// How many values and derivatives are given: one value and a gradient a corner.
    pub const fn data(&self) -> usize {
        CORNERS * (1 + self.shape.dimension())
    }

    /// Where the PDE holds: one point for each coefficient that is not given.
    pub fn collocation_points(&self) -> Vec<[f64; CORNERS]> {
        self.points.iter().flat_map(|&point| self.shape.orbit(point)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::spaces::*;
    use super::*;

    fn check<const CORNERS: usize, const N: usize>(space: Space<CORNERS, N>) {
        let points = space.collocation_points();
        assert_eq!(space.data() + points.len(), N, "{}", space.name);
        for point in points {
            assert!((point.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{}", space.name);
            assert!(point.iter().all(|&weight| weight > 0.0), "{}", space.name);
        }
    }

    #[test]
    fn as_many_points_as_are_missing() {
        check(PCI);
        check(DEI3_13);
        check(DEI3_15);
        check(DEI);
        check(DEI4_15);
        check(FQI);
        check(RECTANGLE);
        check(P3);
        check(P2);
        check(P2_HAT);
    }

    #[test]
    fn monomials_of_dei_3_13_as_printed() {
        // thesis, section 1.7: the matrix C2, where c_ij stands before sⁱ tʲ
        let printed = [
            [0, 0],
            [0, 1],
            [0, 2],
            [0, 3],
            [1, 0],
            [1, 1],
            [1, 2],
            [1, 3],
            [2, 0],
            [2, 1],
            [2, 2],
            [3, 0],
            [3, 1],
        ];
        let mut monomials = DEI3_13.monomials().0;
        monomials.sort_unstable();
        assert_eq!(monomials, printed.map(|[i, j]| [i, j, 0]));
    }
}
