//! The edges that are kept: of the boundary, and between regions.

use std::collections::HashMap;

use super::DelaunayError;
use super::linked::{LinkedTriangles, Pair};

/// A part of an edge of the input that is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feature {
    /// What lies to the left and to the right of it, from its lower to its higher point.
    pub sides: [Side; 2],
    /// The edge of the input, its lower point first.
    pub edge: [u32; 2],
    /// Which part of that edge it is, from its own lower to its higher point.
    pub span: [f64; 2],
    /// How often it may still be halved for the sake of angles alone.
    pub halvings: u8,
}

/// What lies beside an edge: the region of cells there, or nothing.
pub type Side = Option<u32>;

/// All features, by their points, the lower first.
pub type Features = HashMap<[u32; 2], Feature>;

/// Angles alone halve an edge so often at most. It takes one or two; at acute corners of the
/// domain it would go on for ever.
const HALVINGS: u8 = 3;

/// An edge, the lower point first.
pub fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Whether an edge of cells is kept: on the boundary, or between different regions.
pub fn is_kept(pair: &Pair, cells: &LinkedTriangles) -> bool {
    let [left, right] = sides(pair, cells);
    left != right
}

/// The features that these edges of cells are. `used` are the mesh's numbers of the points.
pub fn features(kept: &[Pair], cells: &LinkedTriangles, used: &[u32]) -> Features {
    let feature = |pair: &Pair| {
        let edge = pair.ends.map(|end| used[end as usize]);
        let sides = sides(pair, cells);
        (pair.ends, Feature { sides, edge, span: [0.0, 1.0], halvings: HALVINGS })
    };
    kept.iter().map(feature).collect()
}

fn sides(pair: &Pair, cells: &LinkedTriangles) -> [Side; 2] {
    pair.sides.map(|side| side.and_then(|(cell, _)| cells.triangle(cell).side))
}

/// Refuses a boundary that touches itself: at such a point it has more than two edges.
///
/// # Errors
/// [`DelaunayError::TouchingBoundaries`]
pub fn refuse_touching(features: &Features) -> Result<(), DelaunayError> {
    let mut counts: HashMap<u32, u32> = HashMap::new();
    for feature in features.values().filter(|feature| feature.sides.contains(&None)) {
        feature.edge.into_iter().for_each(|point| *counts.entry(point).or_default() += 1);
    }
    // the least, so that the message is the same every time
    match counts.into_iter().filter(|(_, count)| *count > 2).map(|(point, _)| point).min() {
        Some(point) => Err(DelaunayError::TouchingBoundaries { point }),
        None => Ok(()),
    }
}

impl Feature {
    /// How far its middle is along the edge of the input.
    pub fn middle(&self) -> f64 {
        0.5 * (self.span[0] + self.span[1])
    }

    /// Its halves, from the lower point to the middle and from there to the higher one. The
    /// middle is the highest of all points.
    pub fn halves(&self, halvings: u8) -> [Self; 2] {
        let [left, right] = self.sides;
        let [start, end] = self.span;
        let first = Self { span: [start, self.middle()], halvings, ..*self };
        let second = Self { span: [end, self.middle()], sides: [right, left], ..first };
        [first, second]
    }
}

#[cfg(test)]
mod tests {
    use spade::Point2;

    use super::*;
    use crate::refine::delaunay::linked::Linked;

    fn features_of(cells: &[([u32; 3], u32)]) -> Features {
        let mut linked = LinkedTriangles::new(vec![Point2::new(0.0, 0.0); 5]);
        let cells = cells.iter().map(|&(points, region)| Linked::new(points, Some(region)));
        let mut pairs = linked.add(cells).unwrap();
        pairs.retain(|pair| is_kept(pair, &linked));
        features(&pairs, &linked, &[0, 1, 2, 3, 4])
    }

    #[test]
    fn boundary_and_interface_by_hand() {
        let features = features_of(&[([0, 1, 2], 7), ([2, 1, 3], 8)]);
        assert_eq!(features.len(), 5);
        assert_eq!(features[&[1, 2]].sides, [Some(7), Some(8)]);
        assert_eq!(features[&[0, 2]].sides, [None, Some(7)]);
        let halves = features[&[0, 2]].halves(1)[1].halves(0);
        assert_eq!(halves[0].span, [1.0, 0.75]);
        assert_eq!(halves[1].sides, [None, Some(7)]);
        assert!(!features_of(&[([0, 1, 2], 0), ([2, 1, 3], 0)]).contains_key(&[1, 2]));
    }

    #[test]
    fn boundaries_that_touch_are_refused() {
        let touching = features_of(&[([0, 1, 2], 0), ([2, 3, 4], 0)]);
        let error = refuse_touching(&touching).unwrap_err();
        assert_eq!(error, DelaunayError::TouchingBoundaries { point: 2 });
    }
}
