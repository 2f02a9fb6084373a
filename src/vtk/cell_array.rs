//! Cells as lists of indices, one after the other.

use super::error::ArrayError;
use super::offsets::Offsets;

/// Lists of indices, stored one after the other: the points of cells, the points of
/// faces, or the faces of polyhedra.
///
/// List `i` is `connectivity[offsets[i]..offsets[i + 1]]`. The offsets begin with 0,
/// never fall, and end at the length of the connectivity: every value of this type keeps
/// to that. Those of lists of one size take no memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellArray {
    offsets: Offsets,
    connectivity: Vec<i64>,
}

impl Default for CellArray {
    fn default() -> Self {
        Self { offsets: Offsets::none(), connectivity: Vec::new() }
    }
}

impl CellArray {
    /// No lists.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes ready offsets (one more than there are lists) and connectivity.
    ///
    /// # Errors
    /// The offsets do not begin with 0, fall, or do not end at the length of the
    /// connectivity.
    pub fn from_parts(offsets: Vec<i64>, connectivity: Vec<i64>) -> Result<Self, ArrayError> {
        Self::from_offsets(Offsets::from_vec(offsets)?, connectivity)
    }

    /// Takes ready offsets and connectivity.
    ///
    /// # Errors
    /// The offsets do not end at the length of the connectivity.
    pub(super) fn from_offsets(
        offsets: Offsets,
        connectivity: Vec<i64>,
    ) -> Result<Self, ArrayError> {
        let (found, expected) = (connectivity.len(), offsets.end());
        match found == expected {
            true => Ok(Self { offsets, connectivity }),
            false => Err(ArrayError::Count { found, expected }),
        }
    }

    /// The number of lists.
    pub fn len(&self) -> usize {
        self.offsets.lists()
    }

    /// Whether there are no lists.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// List `index`.
    pub fn get(&self, index: usize) -> Option<&[i64]> {
        self.connectivity.get(self.offsets.range(index)?)
    }

    /// List `index`, to be changed in place.
    pub(super) fn get_mut(&mut self, index: usize) -> Option<&mut [i64]> {
        self.connectivity.get_mut(self.offsets.range(index)?)
    }

    /// The lists in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[i64]> {
        (0..self.len()).map(|index| self.get(index).unwrap_or_default())
    }

    /// Appends a list.
    pub fn push(&mut self, list: &[i64]) {
        self.connectivity.extend_from_slice(list);
        self.offsets.push(list.len());
    }

    /// Appends the list of the numbers in `range`.
    pub(super) fn push_range(&mut self, range: std::ops::Range<usize>) {
        self.offsets.push(range.len());
        // Numbers of things in memory fit.
        self.connectivity.extend(range.start as i64..range.end as i64);
    }

    /// Makes room for exactly that many more values.
    pub fn reserve(&mut self, values: usize) {
        self.connectivity.reserve_exact(values);
    }

    /// Appends the lists of another, their values moved by `shift`.
    pub(super) fn append_moved(&mut self, other: &Self, shift: usize) {
        self.reserve(other.connectivity.len());
        self.connectivity.extend(other.connectivity.iter().map(|value| value + shift as i64));
        self.offsets.append(&other.offsets);
    }

    /// Where each list begins, and the end of the last: one more than there are lists.
    pub fn offsets(&self) -> impl ExactSizeIterator<Item = i64> + '_ {
        self.offsets.iter()
    }

    /// The size of all lists, if they have the same; 0 if there are none.
    pub fn size_of_all(&self) -> Option<usize> {
        self.offsets.size_of_all()
    }

    /// The lists' indices, one list after the other.
    pub fn connectivity(&self) -> &[i64] {
        &self.connectivity
    }

    /// The lists' indices, taken out.
    pub fn into_connectivity(self) -> Vec<i64> {
        self.connectivity
    }

    /// Refuses indices outside `0..count`.
    ///
    /// # Errors
    /// Names the first index outside and its list.
    pub fn check_indices(&self, count: usize) -> Result<(), ArrayError> {
        match first_outside(&self.connectivity, count) {
            None => Ok(()),
            Some(at) => Err(ArrayError::IndexOutOfRange {
                cell: self.offsets.list_of(at),
                index: self.connectivity.get(at).copied().unwrap_or(0),
                count,
            }),
        }
    }
}

/// How many indices one thread checks at a time.
const CHUNK: usize = 1 << 16;

/// The place of the first index outside `0..count`.
pub(super) fn first_outside(indices: &[i64], count: usize) -> Option<usize> {
    use rayon::prelude::*;
    let last = i64::try_from(count).map_or(i64::MAX, |count| count - 1);
    // Negative where the index is, or is greater than the last: no branch for each.
    let signs = |chunk: &[i64]| {
        chunk.iter().fold(0, |signs, index| signs | index | last.wrapping_sub(*index))
    };
    let bad = indices.par_chunks(CHUNK).position_first(|chunk| signs(chunk) < 0)? * CHUNK;
    let rest = indices.get(bad..).unwrap_or_default();
    let place = rest.iter().position(|index| *index < 0 || *index > last)?;
    Some(bad + place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_come_back() {
        let mut cells = CellArray::new();
        cells.push(&[0, 1, 2]);
        cells.push(&[]);
        cells.push(&[2, 3]);
        assert_eq!(cells.len(), 3);
        assert_eq!(cells.get(2), Some(&[2i64, 3][..]));
        assert_eq!(cells.get(3), None);
        assert_eq!(cells.iter().map(<[i64]>::len).collect::<Vec<_>>(), [3, 0, 2]);
        let again = CellArray::from_parts(vec![0, 3, 3, 5], vec![0, 1, 2, 2, 3]);
        assert_eq!(again.unwrap(), cells);
    }

    #[test]
    fn bad_offsets_are_refused() {
        let refuse =
            |offsets: &[i64]| CellArray::from_parts(offsets.to_vec(), vec![0, 1]).unwrap_err();
        assert!(matches!(refuse(&[]), ArrayError::FirstOffset));
        assert!(matches!(refuse(&[1, 2]), ArrayError::FirstOffset));
        assert!(matches!(refuse(&[0, 2, 1]), ArrayError::FallingOffsets { cell: 1 }));
        assert!(matches!(refuse(&[0, 3]), ArrayError::Count { found: 2, expected: 3 }));
    }

    #[test]
    fn indices_outside_are_named_with_their_cell() {
        let cells = CellArray::from_parts(vec![0, 2, 2, 4], vec![0, 1, 1, -1]).unwrap();
        let error = cells.check_indices(2).unwrap_err();
        assert!(matches!(error, ArrayError::IndexOutOfRange { cell: 2, index: -1, count: 2 }));
        assert!(CellArray::new().check_indices(0).is_ok());
        for index in [i64::MIN, -1, 7, i64::MAX] {
            let mut many = vec![6; 3 * CHUNK];
            assert_eq!(first_outside(&many, 7), None);
            many[2 * CHUNK + 5] = index;
            many[2 * CHUNK + 9] = index;
            assert_eq!(first_outside(&many, 7), Some(2 * CHUNK + 5));
        }
        assert_eq!(first_outside(&[i64::MAX], usize::MAX), None);
    }
}
