//! Where in each cell a monitor looks.

use crate::mesh::Random;

/// Where in each cell a monitor looks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SamplePoints {
    /// The cell is cut parallel to its sides, each edge in three: the centroids of the parts,
    /// weighed by their size. Nine in a triangle; fifteen in a tetrahedron, whose parts are
    /// ten tetrahedra, four octahedra, and an upside-down tetrahedron amid them.
    ///
    /// Mirrored cells have mirrored points. None is a triangle's centroid, where the pure
    /// cubic satisfies the PDE, so that a defect there would tell nothing.
    #[default]
    Fixed,
    /// So many random points of each cell, as in the thesis; the same for the same seed.
    Random {
        /// How many: zero counts as one.
        count: u16,
        /// Which of the choices.
        seed: u64,
    },
}

/// Parts of each edge.
const PARTS: usize = 3;

impl SamplePoints {
    /// So many random points where no number is told: as many as there are fixed ones in a
    /// triangle.
    pub const DEFAULT_COUNT: u16 = 9;

    /// The fixed points, with their weights, which sum to one.
    ///
    /// Cut by `λᵢ = n / PARTS`, a simplex falls into parts of `CORNERS - 1` kinds: those of
    /// kind `m` have `Σ ⌊PARTS λᵢ⌋ = PARTS - m`. Their centroids have
    /// `λᵢ = (⌊PARTS λᵢ⌋ + m / CORNERS) / PARTS`, and their sizes are as Euler's numbers.
    pub(super) fn fixed<const CORNERS: usize>(self) -> Vec<([f64; CORNERS], f64)> {
        let sizes: &[f64] = if CORNERS == 3 { &[1.0, 1.0] } else { &[1.0, 4.0, 1.0] };
        let whole = (PARTS as f64).powi(CORNERS as i32 - 1);
        let mut points = Vec::new();
        for (kind, size) in (1..=PARTS).zip(sizes) {
            let floors = lattice::<CORNERS>(PARTS - kind);
            let share = kind as f64 / CORNERS as f64;
            points.extend(floors.into_iter().map(|floors| {
                let at = floors.map(|floor| (floor as f64 + share) / PARTS as f64);
                (at, size / whole)
            }));
        }
        points
    }

    /// The random points of a cell, with their weights, which sum to one; nothing if points
    /// are fixed.
    pub(super) fn random<const CORNERS: usize>(
        self,
        cell: usize,
    ) -> Option<Vec<([f64; CORNERS], f64)>> {
        let Self::Random { count, seed } = self else { return None };
        let mut random = Random::new([seed, cell as u64, 0]);
        let count = count.max(1);
        Some((0..count).map(|_| (random.in_simplex(), 1.0 / f64::from(count))).collect())
    }
}

/// All choices of so many whole numbers with the given sum.
fn lattice<const COUNT: usize>(sum: usize) -> Vec<[usize; COUNT]> {
    let all = (0..(sum + 1).pow(COUNT as u32))
        .map(|code| std::array::from_fn(|place| code / (sum + 1).pow(place as u32) % (sum + 1)));
    all.filter(|numbers: &[usize; COUNT]| numbers.iter().sum::<usize>() == sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const CORNERS: usize>(points: &[([f64; CORNERS], f64)], count: usize) {
        assert_eq!(points.len(), count);
        assert!((points.iter().map(|point| point.1).sum::<f64>() - 1.0).abs() < 1e-15);
        for (at, weight) in points {
            assert!((at.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!(at.iter().all(|&x| x > 0.0));
            // whatever corners change places, the points stay the same
            let mut mirrored = *at;
            mirrored.swap(0, CORNERS - 1);
            assert!(points.contains(&(mirrored, *weight)));
        }
    }

    #[test]
    fn fixed_points_are_symmetric_and_inside() {
        check::<3>(&SamplePoints::Fixed.fixed(), 9);
        check::<4>(&SamplePoints::Fixed.fixed(), 15);
        let centroid = |at: &[f64; 3]| at.iter().all(|x| (x - 1.0 / 3.0).abs() < 0.01);
        assert!(!SamplePoints::Fixed.fixed().iter().any(|(at, _)| centroid(at)));
    }

    #[test]
    fn linear_functions_have_their_mean() {
        let points = SamplePoints::Fixed.fixed::<4>();
        let mean: f64 = points.iter().map(|(at, weight)| at[0] * weight).sum();
        assert!((mean - 0.25).abs() < 1e-15);
    }

    #[test]
    fn random_points_are_those_of_seed_and_cell() {
        let of = |seed, cell| SamplePoints::Random { count: 5, seed }.random::<3>(cell);
        assert_eq!(of(1, 2), of(1, 2));
        assert_ne!(of(1, 2), of(2, 2));
        assert_ne!(of(1, 2), of(1, 3));
        assert_eq!(of(1, 2).unwrap().len(), 5);
        assert_eq!(SamplePoints::Fixed.random::<3>(0), None);
    }
}
