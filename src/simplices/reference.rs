//! Reference cells of quadratic elements.

/// A point of a reference cell.
pub type Place = [f64; 3];

/// The reference cells. Coordinates go from 0 to 1, but for the pyramid: its base
/// is the square from -1 to 1, its apex at (0, 0, 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// A triangle.
    Triangle,
    /// A square.
    Square,
    /// A tetrahedron.
    Tetrahedron,
    /// A triangle times a segment.
    Wedge,
    /// A cube.
    Cube,
    /// A pyramid.
    Pyramid,
}

impl Reference {
    /// Two or three.
    pub fn dimension(self) -> u8 {
        if matches!(self, Self::Triangle | Self::Square) { 2 } else { 3 }
    }

    /// Its area or volume.
    pub fn measure(self) -> f64 {
        match self {
            Self::Triangle | Self::Wedge => 0.5,
            Self::Square | Self::Cube => 1.0,
            Self::Tetrahedron => 1.0 / 6.0,
            Self::Pyramid => 4.0 / 3.0,
        }
    }

    /// Its corners, in VTK's order.
    fn corners(self) -> &'static [[i8; 3]] {
        match self {
            Self::Triangle => &[[0, 0, 0], [1, 0, 0], [0, 1, 0]],
            Self::Square => &[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
            Self::Tetrahedron => &[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
            Self::Wedge => &[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]],
            Self::Cube => &[
                [0, 0, 0],
                [1, 0, 0],
                [1, 1, 0],
                [0, 1, 0],
                [0, 0, 1],
                [1, 0, 1],
                [1, 1, 1],
                [0, 1, 1],
            ],
            Self::Pyramid => &[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 1]],
        }
    }

    /// The corners whose means are the other nodes of the largest quadratic cell,
    /// in VTK's order. Smaller cells have the first of them.
    fn means(self) -> &'static [&'static [usize]] {
        match self {
            Self::Triangle => &[&[0, 1], &[1, 2], &[2, 0], &[0, 1, 2]],
            Self::Square => &[&[0, 1], &[1, 2], &[2, 3], &[3, 0], &[0, 1, 2, 3]],
            Self::Tetrahedron => &[&[0, 1], &[1, 2], &[2, 0], &[0, 3], &[1, 3], &[2, 3]],
            Self::Wedge => &[
                &[0, 1],
                &[1, 2],
                &[2, 0],
                &[3, 4],
                &[4, 5],
                &[5, 3],
                &[0, 3],
                &[1, 4],
                &[2, 5],
                &[0, 1, 4, 3],
                &[1, 2, 5, 4],
                &[2, 0, 3, 5],
            ],
            Self::Cube => &[
                &[0, 1],
                &[1, 2],
                &[2, 3],
                &[3, 0],
                &[4, 5],
                &[5, 6],
                &[6, 7],
                &[7, 4],
                &[0, 4],
                &[1, 5],
                &[2, 6],
                &[3, 7],
                &[0, 4, 7, 3],
                &[1, 2, 6, 5],
                &[0, 1, 5, 4],
                &[3, 7, 6, 2],
                &[0, 3, 2, 1],
                &[4, 5, 6, 7],
                &[0, 1, 2, 3, 4, 5, 6, 7],
            ],
            Self::Pyramid => {
                &[&[0, 1], &[1, 2], &[2, 3], &[3, 0], &[0, 4], &[1, 4], &[2, 4], &[3, 4]]
            }
        }
    }

    /// The places of a cell's nodes: all corners, then the means with the given
    /// numbers.
    pub fn nodes(self, means: impl Iterator<Item = usize>) -> Vec<Place> {
        let place = |&corner: &usize| self.corners()[corner].map(f64::from);
        let mean = |number: usize| {
            let corners = self.means()[number];
            let sum = |axis: usize| corners.iter().map(|corner| place(corner)[axis]).sum::<f64>();
            [0, 1, 2].map(|axis| sum(axis) / corners.len() as f64)
        };
        let corners: Vec<usize> = (0..self.corners().len()).collect();
        corners.iter().map(place).chain(means.map(mean)).collect()
    }
}
