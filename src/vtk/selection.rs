//! Which arrays to read.

/// Which arrays of points and cells to read. Points, cells and field data always are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// Every array.
    #[default]
    All,
    /// The arrays of these names; the others are not decoded.
    Named {
        /// Names of point arrays.
        points: Vec<String>,
        /// Names of cell arrays.
        cells: Vec<String>,
    },
}

impl Selection {
    /// No array at all.
    pub fn none() -> Self {
        Self::named([] as [&str; 0], [] as [&str; 0])
    }

    /// The point and cell arrays of these names.
    pub fn named<P, C>(points: P, cells: C) -> Self
    where
        P: IntoIterator,
        P::Item: Into<String>,
        C: IntoIterator,
        C::Item: Into<String>,
    {
        Self::Named {
            points: points.into_iter().map(Into::into).collect(),
            cells: cells.into_iter().map(Into::into).collect(),
        }
    }

    /// The point arrays asked for by name; `None` for all.
    pub(super) fn points(&self) -> Option<&[String]> {
        match self {
            Self::All => None,
            Self::Named { points, .. } => Some(points),
        }
    }

    /// The cell arrays asked for by name; `None` for all.
    pub(super) fn cells(&self) -> Option<&[String]> {
        match self {
            Self::All => None,
            Self::Named { cells, .. } => Some(cells),
        }
    }
}
