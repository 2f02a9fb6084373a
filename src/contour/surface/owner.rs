//! Who owns a point of a surface.

/// The part of the mesh, or of the divided mesh, that owns a point of a surface: its name
/// within a level. Pieces that share the part compute the point from the same numbers, so
/// they get the same bits under the same name, and surfaces close without any comparison
/// of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Owner {
    /// A vertex that lies on the level.
    Vertex(u32),
    /// The crossing of an edge.
    Edge {
        /// The edge's vertex of lower number.
        low: u32,
        /// The edge's vertex of higher number.
        high: u32,
    },
    /// A point of an edge that lies on the level as a whole.
    OnEdge {
        /// The edge's vertex of lower number.
        low: u32,
        /// The edge's vertex of higher number.
        high: u32,
        /// The bits of the higher vertex's weight.
        weight: u64,
    },
    /// A point of a face that lies on the level as a whole.
    OnFace {
        /// The face's vertices, ascending.
        vertices: [u32; 3],
        /// The bits of the weights of the last two.
        weights: [u64; 2],
    },
    /// Where a face's ray crosses the level.
    Face {
        /// The vertex from which the face's rays run.
        apex: u32,
        /// The vertex of lower number of the edge opposite.
        low: u32,
        /// The other vertex of that edge.
        high: u32,
        /// Where the ray meets that edge: the bits of the higher vertex's weight.
        weight: u64,
    },
    /// A point of its patch alone.
    Patch,
}

impl Owner {
    /// Whether it lies on the level as a whole.
    pub fn is_on_level(&self) -> bool {
        matches!(self, Self::Vertex(_) | Self::OnEdge { .. } | Self::OnFace { .. })
    }
}
