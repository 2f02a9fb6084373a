//! Where the PDE is to hold.

use super::shape::Shape;

/// Where the PDE is to hold in each cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CollocationPoints {
    /// At the points of the space.
    #[default]
    Chosen,
    /// At random points of each cell, as in the thesis; the same for the same seed.
    Random {
        /// Which of the choices.
        seed: u64,
    },
    /// At the best of several random choices in each cell: with the DEI's space this is
    /// the ADEI (thesis, section 1.5).
    ///
    /// The thesis tells its idea only: points are chosen anew until the coefficients are
    /// small. Here: until they are not above three times the data (as
    /// [`DeiOptions::limit`](super::DeiOptions::limit) measures them), at most five times,
    /// and the choice with the smallest is kept. Twenty times and twice the data take two
    /// to three times as long for errors a sixth smaller.
    Searched {
        /// Which of the choices.
        seed: u64,
    },
}

/// Random choices of points at most.
const CHOICES: usize = 5;

/// Coefficients of this size are small enough to end the search.
const SMALL: f64 = 3.0;

impl CollocationPoints {
    /// How often points are chosen in a cell at most, and which size of the coefficients
    /// ends the search.
    pub(super) fn search(self) -> (usize, f64) {
        match self {
            Self::Chosen | Self::Random { .. } => (1, f64::INFINITY),
            Self::Searched { .. } => (CHOICES, SMALL),
        }
    }

    /// The points of a cell at a turn of the search, as weights of its corners.
    pub(super) fn of_cell<const CORNERS: usize>(
        self,
        shape: Shape,
        chosen: &[[f64; CORNERS]],
        cell: usize,
        turn: usize,
    ) -> Vec<[f64; CORNERS]> {
        match self {
            Self::Chosen => chosen.to_vec(),
            Self::Random { seed } | Self::Searched { seed } => {
                let mut random = Random::new([seed, cell as u64, turn as u64]);
                chosen.iter().map(|_| random.point(shape)).collect()
            }
        }
    }
}

/// Random numbers, the same every time and on every thread: SplitMix64 (Steele, Lea,
/// Flood 2014).
struct Random(u64);

impl Random {
    /// The numbers that belong to some others.
    fn new(of: [u64; 3]) -> Self {
        let mut random = Self(0);
        for number in of {
            random.0 ^= number;
            random.0 = random.bits();
        }
        random
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// A number above 0 and up to 1.
    fn unit(&mut self) -> f64 {
        ((self.bits() >> 11) + 1) as f64 / (1_u64 << 53) as f64
    }

    /// A point of a cell, all places alike, as weights of the corners.
    fn point<const CORNERS: usize>(&mut self, shape: Shape) -> [f64; CORNERS] {
        if shape == Shape::Rectangle {
            let (s, t) = (self.unit(), self.unit());
            let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
            return std::array::from_fn(|corner| weights[corner]);
        }
        // waiting times, as parts of their sum, are uniform in a simplex
        let weights = [(); CORNERS].map(|()| -self.unit().ln());
        let sum: f64 = weights.iter().sum();
        weights.map(|weight| weight / sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_points_fill_their_cell() {
        let mut random = Random::new([1, 2, 3]);
        let mut mean = [0.0; 4];
        let mut second = 0.0;
        for _ in 0..4000 {
            let point: [f64; 4] = random.point(Shape::Tetrahedron);
            assert!((point.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            assert!(point.iter().all(|&weight| weight >= 0.0));
            mean.iter_mut().zip(point).for_each(|(mean, weight)| *mean += weight / 4000.0);
            second += point[0] * point[0] / 4000.0;
        }
        assert!(mean.iter().all(|&mean| (mean - 0.25).abs() < 0.02));
        // of a uniform distribution: 2! 3! / 5!
        assert!((second - 0.1).abs() < 0.01);
    }

    #[test]
    fn cells_and_turns_have_points_of_their_own() {
        let points = CollocationPoints::Searched { seed: 7 };
        let chosen = [[1.0 / 3.0; 3]];
        let of = |cell, turn| points.of_cell(Shape::Triangle, &chosen, cell, turn);
        assert_eq!(of(1, 2), of(1, 2));
        assert_ne!(of(1, 2), of(2, 1));
        assert_eq!(CollocationPoints::Chosen.of_cell(Shape::Triangle, &chosen, 1, 2), chosen);
    }
}
