//! The edges that are kept: of the boundary, and between regions.

use std::collections::HashMap;

use super::DelaunayError;
use crate::mesh::TriangleMesh;

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

/// All edges of the mesh, and of them those that are kept. `is_turned` tells of each cell
/// whether its corners run clockwise; `regions` is one number a cell, or empty.
///
/// # Errors
/// If an edge belongs to more than two cells, or two cells lie on the same side of one.
pub fn edges_and_features(
    mesh: &TriangleMesh,
    regions: &[u32],
    is_turned: impl Fn(usize) -> bool,
) -> Result<(Vec<[usize; 2]>, Features), DelaunayError> {
    let mut sides: Vec<([u32; 2], bool, u32)> = Vec::with_capacity(3 * mesh.triangles().len());
    for (cell, &[a, b, c]) in mesh.triangles().iter().enumerate() {
        let region = regions.get(cell).copied().unwrap_or(0);
        for [from, to] in [[a, b], [b, c], [c, a]] {
            sides.push((sorted([from, to]), (from < to) == is_turned(cell), region));
        }
    }
    rayon::slice::ParallelSliceMut::par_sort_unstable(&mut sides[..]);
    let mut edges = Vec::with_capacity(sides.len() / 2 + 1);
    let mut features = Features::new();
    for group in sides.chunk_by(|one, next| one.0 == next.0) {
        let edge = group[0].0;
        edges.push(edge.map(|point| point as usize));
        let mut beside = [None; 2];
        for &(_, is_right, region) in group {
            if beside[usize::from(is_right)].replace(region).is_some() {
                return Err(match group.len() {
                    2 => DelaunayError::CrossingEdges { ends: edge },
                    _ => DelaunayError::Branching { ends: edge },
                });
            }
        }
        if beside[0] == beside[1] {
            continue;
        }
        features
            .insert(edge, Feature { sides: beside, edge, span: [0.0, 1.0], halvings: HALVINGS });
    }
    Ok((edges, features))
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
    use super::*;
    use crate::mesh::Vector;

    #[test]
    fn boundary_and_interface_by_hand() {
        let mesh = TriangleMesh::new(vec![Vector::zeros(); 4], vec![[0, 1, 2], [2, 1, 3]]).unwrap();
        let (edges, features) = edges_and_features(&mesh, &[7, 8], |_| false).unwrap();
        assert_eq!(edges.len(), 5);
        assert_eq!(features.len(), 5);
        assert_eq!(features[&[1, 2]].sides, [Some(7), Some(8)]);
        assert_eq!(features[&[0, 2]].sides, [None, Some(7)]);
        let (_, features) = edges_and_features(&mesh, &[], |_| false).unwrap();
        assert!(!features.contains_key(&[1, 2]));
        let halves = features[&[0, 2]].halves(1)[1].halves(0);
        assert_eq!(halves[0].span, [1.0, 0.75]);
        assert_eq!(halves[1].sides, [None, Some(0)]);
    }

    #[test]
    fn what_does_not_fit_together_is_refused() {
        let with = |cells: Vec<[u32; 3]>| {
            let mesh = TriangleMesh::new(vec![Vector::zeros(); 9], cells).unwrap();
            edges_and_features(&mesh, &[], |_| false).unwrap_err()
        };
        let three = with(vec![[0, 1, 2], [2, 1, 3], [1, 2, 4]]);
        assert_eq!(three, DelaunayError::Branching { ends: [1, 2] });
        let over = with(vec![[0, 1, 2], [1, 2, 4]]);
        assert_eq!(over, DelaunayError::CrossingEdges { ends: [1, 2] });
        let cells = vec![[0, 1, 2], [2, 3, 4]];
        let mesh = TriangleMesh::new(vec![Vector::zeros(); 5], cells).unwrap();
        let (_, features) = edges_and_features(&mesh, &[], |_| false).unwrap();
        let touching = refuse_touching(&features).unwrap_err();
        assert_eq!(touching, DelaunayError::TouchingBoundaries { point: 2 });
    }
}
