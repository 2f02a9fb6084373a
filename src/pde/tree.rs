//! The syntax tree of an equation, as it was written.
//!
//! The nodes lie in one vector, children before parents, so that every pass
//! over the tree is a loop: a sum of ten thousand terms needs no deep stack.

use super::operation::{Binary, Unary};

/// Index of a node.
pub(super) type NodeId = usize;

/// A node without operands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Leaf {
    Number(f64),
    /// Number in [`INPUTS`](super::names::INPUTS), or 7 + slot of a used array.
    Input(usize),
    /// Number in [`SECOND`](super::names::SECOND).
    Second(usize),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NodeKind {
    Leaf(Leaf),
    Unary(Unary, NodeId),
    Binary(Binary, NodeId, NodeId),
}

/// A node and the byte of the text where its name or operator stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    pub at: usize,
    pub kind: NodeKind,
}

/// An equation: nodes and the roots of its two sides.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tree {
    pub nodes: Vec<Node>,
    pub left: NodeId,
    pub right: NodeId,
}
