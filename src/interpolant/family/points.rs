//! Where the PDE is to hold.

use super::shape::Shape;
use crate::mesh::Random;

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
                chosen.iter().map(|_| random_point(&mut random, shape)).collect()
            }
        }
    }
}

/// A random point of a cell, all places alike, as weights of the corners.
fn random_point<const CORNERS: usize>(random: &mut Random, shape: Shape) -> [f64; CORNERS] {
    if shape == Shape::Rectangle {
        let (s, t) = (random.unit(), random.unit());
        let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
        return std::array::from_fn(|corner| weights[corner]);
    }
    random.in_simplex()
}

#[cfg(test)]
mod tests {
    use super::*;

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
