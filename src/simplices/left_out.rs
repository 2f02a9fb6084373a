//! The cells that could not be split, and why.

use std::collections::BTreeMap;
use std::fmt;

use super::cell_type::name;

/// Why a cell was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Reason {
    /// Its type is none that can be split.
    Unsupported,
    /// Its order is above two.
    HighOrder,
    /// It has another number of points than its type asks for.
    PointCount,
    /// It names the same points again, so that no area or volume is left.
    Collapsed,
    /// A polygon whose edges cross.
    CrossingEdges,
    /// A polygon of more points than [`MOST_CORNERS`](super::MOST_CORNERS).
    ManyCorners,
    /// A polyhedron whose faces do not form one closed surface.
    OpenSurface,
    /// A polyhedron too far from convex.
    NotConvex,
    /// A Bézier cell with rational weights that are not positive.
    Weights,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unsupported => "not supported",
            Self::HighOrder => "of order above 2",
            Self::PointCount => "with a wrong number of points",
            Self::Collapsed => "collapsed to nothing",
            Self::CrossingEdges => "whose edges cross",
            Self::ManyCorners => "with too many corners",
            Self::OpenSurface => "whose faces do not close",
            Self::NotConvex => "far from convex",
            Self::Weights => "with weights that are not positive",
        })
    }
}

/// How many cells of each type were left out for each reason.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LeftOut(BTreeMap<(u8, Reason), usize>);

impl LeftOut {
    /// Counts one more cell of a type.
    pub fn add(&mut self, cell_type: u8, reason: Reason) {
        *self.0.entry((cell_type, reason)).or_default() += 1;
    }

    /// How many cells there are in all.
    pub fn total(&self) -> usize {
        self.0.values().sum()
    }

    /// Type, reason and number of cells, in order of type.
    pub fn iter(&self) -> impl Iterator<Item = (u8, Reason, usize)> + '_ {
        self.0.iter().map(|(&(cell_type, reason), &count)| (cell_type, reason, count))
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = |(cell_type, reason, count): (u8, Reason, usize)| {
            format!("{count} {} ({reason})", name(cell_type))
        };
        let parts: Vec<String> = self.iter().map(part).collect();
        f.write_str(if parts.is_empty() { "no cells" } else { "" })?;
        f.write_str(&parts.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_told_apart() {
        let mut left_out = LeftOut::default();
        assert_eq!(left_out.to_string(), "no cells");
        left_out.add(7, Reason::CrossingEdges);
        left_out.add(7, Reason::Collapsed);
        left_out.add(7, Reason::CrossingEdges);
        assert_eq!(left_out.total(), 3);
        assert_eq!(
            left_out.to_string(),
            "1 polygons (collapsed to nothing), 2 polygons (whose edges cross)"
        );
    }
}
