//! A refined mesh, and where everything in it comes from.

use crate::mesh::Vector;

/// A refined mesh, in the terms of the mesh that was refined (the input), so that
/// whatever data the input has can be carried over.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Refinement<const CORNERS: usize> {
    /// The points, in the mesh's unit of length: those of the input first, in their order and
    /// where they were (but for `moved`), then the new ones.
    pub points: Vec<Vector>,
    /// The cells, as numbers of their points, turned as those of the input are.
    pub cells: Vec<[u32; CORNERS]>,
    /// For each cell, that of the input in which it lies: in which its centroid lies, where
    /// cells of the input were not divided but replaced.
    pub parents: Vec<u32>,
    /// Where each point past those of the input lies.
    pub new_points: Vec<NewPoint<CORNERS>>,
    /// Points of the input that were moved, ascending.
    pub moved: Vec<MovedPoint<CORNERS>>,
    /// What the method has to know to go on with this mesh, one number a cell; nothing where
    /// it needs none.
    pub state: Vec<u16>,
}

/// Where a new point lies in the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NewPoint<const CORNERS: usize> {
    /// On an edge.
    Edge {
        /// The edge's points, the lesser number first.
        ends: [u32; 2],
        /// How far from the first end to the second, between 0 and 1.
        at: f64,
    },
    /// In a cell, or on one of its faces.
    Inside {
        /// The cell.
        cell: u32,
        /// Barycentric coordinates there.
        at: [f64; CORNERS],
    },
}

/// A point of the input that is elsewhere now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovedPoint<const CORNERS: usize> {
    /// The point.
    pub point: u32,
    /// The cell of the input in which it lies now.
    pub cell: u32,
    /// Barycentric coordinates there.
    pub at: [f64; CORNERS],
}
