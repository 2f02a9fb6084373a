//! Higher-order hexahedra of files written before VTK 9, which numbers their nodes anew.

use super::attributes::Attributes;
use super::cell_array::CellArray;
use std::ops::Range;

/// VTK's types of hexahedra of any order: isoparametric, Lagrange, Bézier.
const KINDS: [u8; 3] = [67, 72, 79];

/// The arrays of the three orders of each cell; without it a cell has the same in all
/// directions.
const DEGREES: &str = "HigherOrderDegrees";

/// The first versions of XML and legacy files in which nodes have their new numbers.
pub(super) const XML_VERSION: (u32, u32) = (2, 1);
pub(super) const LEGACY_VERSION: (u32, u32) = (5, 1);

/// Whether there are such cells, so that a file needs the new version.
pub(super) fn has_any(types: &[u8]) -> bool {
    types.iter().any(|kind| KINDS.contains(kind))
}

/// Whether a file's version is before that one; so is a file without a version.
pub(super) fn is_before(version: &str, other: (u32, u32)) -> bool {
    let mut numbers = version.split('.').map(|number| number.trim().parse().unwrap_or(0));
    let mut next = || numbers.next().unwrap_or(0);
    (next(), next()) < other
}

/// Gives the nodes of the cells in `range` their new places: those of the last two of the
/// four edges along the third direction are exchanged.
pub(super) fn renumber(
    cells: &mut CellArray,
    types: &[u8],
    range: Range<usize>,
    cell_data: &Attributes,
) {
    let degrees = cell_data.get(DEGREES).filter(|array| array.components == 3);
    let degrees = degrees.and_then(|array| array.to_f64());
    for cell in range.filter(|cell| types.get(*cell).is_some_and(|kind| KINDS.contains(kind))) {
        let Some(nodes) = cells.get_mut(cell) else {
            continue;
        };
        let given = degrees.as_ref().and_then(|all| all.get(3 * cell..3 * cell + 3));
        let inner = match given {
            Some(orders) => orders.iter().map(|order| *order as usize).collect(),
            None => vec![uniform_order(nodes.len()); 3],
        };
        exchange(nodes, &inner.iter().map(|order| order.saturating_sub(1)).collect::<Vec<_>>());
    }
}

/// The order of a hexahedron with that many nodes.
fn uniform_order(nodes: usize) -> usize {
    ((nodes as f64).cbrt().round() as usize).saturating_sub(1)
}

/// `inner`: how many nodes an edge of each direction has between its ends.
fn exchange(nodes: &mut [i64], inner: &[usize]) {
    let &[x, y, z] = inner else {
        return;
    };
    let place = x.saturating_add(y).saturating_mul(4).saturating_add(z.saturating_mul(2));
    let edges = nodes.get_mut(place.saturating_add(8)..).unwrap_or_default();
    if let Some(edges) = edges.get_mut(..z.saturating_mul(2)) {
        let (left, right) = edges.split_at_mut(z);
        left.swap_with_slice(right);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::data_array::DataArray;

    #[test]
    fn versions_are_compared_as_numbers() {
        for old in ["", "0.1", "1.0", "2.0", "x", "2"] {
            assert!(is_before(old, XML_VERSION), "{old}");
        }
        for new in ["2.1", "2.3", "3.0", "10.0"] {
            assert!(!is_before(new, XML_VERSION), "{new}");
        }
    }

    /// As VTK 9.7 reads a file of version 1.0 with such a cell.
    #[test]
    fn two_edges_are_exchanged() {
        let nodes: Vec<i64> = (0..27).collect();
        let mut cells = CellArray::new();
        (0..2).for_each(|_| cells.push(&nodes));
        renumber(&mut cells, &[72, 12], 0..2, &Attributes::new());
        assert_eq!(cells.get(0).unwrap()[16..21], [16i64, 17, 19, 18, 20]);
        assert_eq!(cells.get(1).unwrap(), nodes);
    }

    #[test]
    fn orders_may_differ() {
        // Orders 1, 2, 3: 8 corners, 4 nodes along y, 8 along z, ...
        let mut cells = CellArray::new();
        cells.push(&(0..24).collect::<Vec<i64>>());
        let degrees = DataArray::new(DEGREES, 3, vec![1.0f64, 2.0, 3.0]);
        let data: Attributes = [degrees].into_iter().collect();
        renumber(&mut cells, &[79], 0..1, &data);
        assert_eq!(cells.get(0).unwrap()[14..22], [14i64, 15, 18, 19, 16, 17, 20, 21]);
        for forged in [f64::NAN, 1e300, -1.0] {
            let degrees = DataArray::new(DEGREES, 3, vec![forged; 3]);
            renumber(&mut cells, &[79], 0..1, &[degrees].into_iter().collect());
        }
        assert_eq!(cells.connectivity().len(), 24);
    }
}
