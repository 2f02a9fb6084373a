//! Which arrays to read.

use super::description::{ArrayInfo, Description};

/// Which arrays of points and cells to read. Points, cells and field data always are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// Every array.
    #[default]
    All,
    /// The arrays of these names; the others are not decoded. One that is missing or cannot
    /// be used is an error.
    Named {
        /// Names of point arrays.
        points: Vec<String>,
        /// Names of cell arrays.
        cells: Vec<String>,
    },
    /// Of these names the arrays that [`All`](Self::All) would give; the others are not
    /// decoded.
    AtMost {
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

    /// The arrays that a description lists: of pieces, those that all of them have.
    pub fn all_of(description: &Description) -> Self {
        let names = |arrays: &[ArrayInfo]| arrays.iter().map(|a| a.name.clone()).collect();
        let (points, cells) = (names(&description.point_arrays), names(&description.cell_arrays));
        Self::AtMost { points, cells }
    }

    /// What is asked of the point arrays.
    pub(super) fn points(&self) -> Choice<'_> {
        match self {
            Self::All => Choice::All,
            Self::Named { points, .. } => Choice::Named(points),
            Self::AtMost { points, .. } => Choice::AtMost(points),
        }
    }

    /// What is asked of the cell arrays.
    pub(super) fn cells(&self) -> Choice<'_> {
        match self {
            Self::All => Choice::All,
            Self::Named { cells, .. } => Choice::Named(cells),
            Self::AtMost { cells, .. } => Choice::AtMost(cells),
        }
    }
}

/// Which arrays of one section to read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice<'a> {
    /// Every array.
    All,
    /// These, which must be there.
    Named(&'a [String]),
    /// Those of these that are there.
    AtMost(&'a [String]),
}

impl Choice<'_> {
    /// Whether an array of that name is read if it is there.
    pub(super) fn has(&self, name: &String) -> bool {
        match self {
            Self::All => true,
            Self::Named(names) | Self::AtMost(names) => names.contains(name),
        }
    }
}
