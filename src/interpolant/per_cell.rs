//! What is kept for the cells of a mesh, or their faces.

use crate::mesh::Subset;

/// Something for each cell (or face) of a mesh, for some of them, or for none.
#[derive(Clone, Debug, Default)]
pub(super) enum PerCell<T> {
    /// For each cell, in their order.
    All(Vec<T>),
    /// For some, in their order.
    Some(Subset, Vec<T>),
    /// For none.
    #[default]
    None,
}

impl<T> PerCell<T> {
    /// What is kept for a cell, if anything is.
    pub fn get(&self, cell: usize) -> Option<&T> {
        match self {
            Self::All(all) => Some(&all[cell]),
            Self::Some(cells, some) => cells.place(cell).map(|place| &some[place]),
            Self::None => None,
        }
    }
}
