//! Points of a contour, and who owns them.
//!
//! Every crossing belongs to the smallest part of the mesh that holds it: a
//! point, an edge or a cell. Neighbouring cells compute a crossing of their
//! common edge from the same four numbers in the same order, so they get the
//! same bits under the same name, and lines join without any comparison of
//! coordinates.

use crate::bernstein::Barycentric;
use crate::mesh::Vector;

/// The part of the mesh that owns a point of a contour: its name within a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Owner {
    /// A point of the mesh that lies on the level.
    Point(u32),
    /// A crossing of an edge.
    Edge {
        /// The edge's point of lower number.
        low: u32,
        /// The edge's point of higher number.
        high: u32,
        /// Which crossing, counted from `low`.
        place: u8,
    },
    /// A crossing inside a cell.
    Cell {
        /// The cell.
        cell: u32,
        /// Which crossing of this cell.
        place: u32,
    },
}

/// A point of a contour in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Who owns it.
    pub owner: Owner,
    /// Where it lies in the cell.
    pub at: Barycentric,
    /// Where it lies in space: to the last bit the same in all cells that share it.
    pub position: Vector,
}
