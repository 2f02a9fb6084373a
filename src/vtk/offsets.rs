//! Where lists that stand one after the other begin and end.

use std::ops::Range;

use super::error::ArrayError;

/// Where lists that stand one after the other begin and end.
///
/// Lists of one size, as those of a mesh of nothing but triangles, need no number each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Offsets(Form);

/// Each sequence of lists has one form only, so that equal ones compare equal.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Form {
    /// So many of the same size; 0 if there are none.
    Regular { lists: usize, size: usize },
    /// Of several sizes: where each begins, and the end of the last. The first is 0, none falls.
    Several(Vec<i64>),
}

impl Offsets {
    /// No lists.
    pub(super) fn none() -> Self {
        Self::regular(0, 0)
    }

    /// So many lists of one size.
    pub(super) fn regular(lists: usize, size: usize) -> Self {
        Self(Form::Regular { lists, size: if lists == 0 { 0 } else { size } })
    }

    /// Takes where each list begins, and the end of the last.
    ///
    /// # Errors
    /// They do not begin with 0, or fall.
    pub(super) fn from_vec(offsets: Vec<i64>) -> Result<Self, ArrayError> {
        let Some((0, ends)) = offsets.split_first() else {
            return Err(ArrayError::FirstOffset);
        };
        if ends.is_empty() {
            return Ok(Self::none());
        }
        match common_difference(ends.iter().copied().map(Some)) {
            Some(size) => Ok(Self::regular(ends.len(), size)),
            None => check_rising(&offsets).map(|()| Self(Form::Several(offsets))),
        }
    }

    /// How many lists there are.
    pub(super) fn lists(&self) -> usize {
        match &self.0 {
            Form::Regular { lists, .. } => *lists,
            Form::Several(offsets) => offsets.len() - 1,
        }
    }

    /// The size of all lists, if they have the same.
    pub(super) fn size_of_all(&self) -> Option<usize> {
        match self.0 {
            Form::Regular { size, .. } => Some(size),
            Form::Several(_) => None,
        }
    }

    /// Where list `index` is.
    pub(super) fn range(&self, index: usize) -> Option<Range<usize>> {
        match &self.0 {
            Form::Regular { lists, size } => {
                (index < *lists).then(|| index * size..(index + 1) * size)
            }
            Form::Several(offsets) => {
                // numbers of things in memory fit
                let start = *offsets.get(index)? as usize;
                Some(start..*offsets.get(index + 1)? as usize)
            }
        }
    }

    /// The end of the last list.
    pub(super) fn end(&self) -> usize {
        match &self.0 {
            Form::Regular { lists, size } => lists * size,
            Form::Several(offsets) => offsets.last().map_or(0, |end| *end as usize),
        }
    }

    /// Where each list begins, and the end of the last.
    pub(super) fn iter(&self) -> impl ExactSizeIterator<Item = i64> + '_ {
        (0..self.lists() + 1).map(|index| match &self.0 {
            Form::Regular { size, .. } => (index * size) as i64,
            Form::Several(offsets) => offsets[index],
        })
    }

    /// The list that a place is in.
    pub(super) fn list_of(&self, place: usize) -> usize {
        match &self.0 {
            Form::Regular { size, .. } => place / size.max(&1),
            Form::Several(offsets) => {
                offsets.partition_point(|offset| *offset <= place as i64).saturating_sub(1)
            }
        }
    }

    /// Appends a list of a size.
    pub(super) fn push(&mut self, size: usize) {
        self.append(&Self::regular(1, size));
    }

    /// Appends other lists.
    pub(super) fn append(&mut self, other: &Self) {
        match (&mut self.0, &other.0) {
            (_, Form::Regular { lists: 0, .. }) => {}
            (Form::Regular { lists: 0, .. }, _) => *self = other.clone(),
            (Form::Regular { lists, size }, Form::Regular { lists: more, size: same })
                if size == same =>
            {
                *lists += more;
            }
            (Form::Regular { .. }, _) => {
                let mut offsets = Vec::with_capacity(self.lists() + other.lists() + 1);
                offsets.extend(self.iter());
                self.0 = Form::Several(offsets);
                self.append(other);
            }
            (Form::Several(offsets), _) => {
                let end = offsets.last().copied().unwrap_or(0);
                offsets.extend(other.iter().skip(1).map(|offset| end + offset));
            }
        }
    }
}

/// The first of some ends of lists, if it is the difference of each and the one before, too: the size
/// of all. An end may be no number of an offset.
pub(super) fn common_difference(
    ends: impl ExactSizeIterator<Item = Option<i64>> + Clone,
) -> Option<usize> {
    let first = usize::try_from(ends.clone().next()??).ok()?;
    // so that the others do not overflow
    i64::try_from(first.checked_mul(ends.len())?).ok()?;
    let mut expected = 0;
    // without a branch for each
    let are_all = ends.fold(true, |all, end| {
        expected += first as i64;
        all & (end == Some(expected))
    });
    are_all.then_some(first)
}

/// Refuses offsets that fall.
fn check_rising(offsets: &[i64]) -> Result<(), ArrayError> {
    // Seldom false, so looked at as a whole first, without a branch for each.
    let pairs = offsets.iter().zip(offsets.iter().skip(1));
    if !pairs.fold(false, |any, (left, right)| any | (left > right)) {
        return Ok(());
    }
    let cell = offsets.windows(2).position(|pair| pair[0] > pair[1]);
    Err(ArrayError::FallingOffsets { cell: cell.unwrap_or(0) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn offsets_that_fall_or_overflow_are_refused() {
        let refuse = |offsets: &[i64]| Offsets::from_vec(offsets.to_vec()).unwrap_err();
        assert!(matches!(refuse(&[]), ArrayError::FirstOffset));
        assert!(matches!(refuse(&[1, 2]), ArrayError::FirstOffset));
        assert!(matches!(refuse(&[0, 2, 1]), ArrayError::FallingOffsets { cell: 1 }));
        assert!(matches!(refuse(&[0, -2, -4]), ArrayError::FallingOffsets { cell: 0 }));
        // regular but for the sign
        assert!(matches!(refuse(&[0, i64::MAX, -2]), ArrayError::FallingOffsets { cell: 1 }));
        assert_eq!(Offsets::from_vec(vec![0]), Ok(Offsets::none()));
    }

    proptest! {
        #[test]
        fn lists_are_where_they_were_put(
            sizes in prop::collection::vec(prop_oneof![4 => Just(3_usize), 1 => 0..5_usize], 0..12),
            cut in 0..12_usize,
        ) {
            let ends = sizes.iter().scan(0, |end, size| { *end += size; Some(*end as i64) });
            let expected: Vec<i64> = std::iter::once(0).chain(ends).collect();
            let mut pushed = Offsets::none();
            sizes.iter().for_each(|&size| pushed.push(size));
            let whole = Offsets::from_vec(expected.clone()).unwrap();
            let mut joined = Offsets::none();
            for part in [&sizes[..cut.min(sizes.len())], &sizes[cut.min(sizes.len())..]] {
                let mut offsets = Offsets::none();
                part.iter().for_each(|&size| offsets.push(size));
                joined.append(&offsets);
            }
            prop_assert_eq!(&pushed, &whole);
            prop_assert_eq!(&joined, &whole);
            prop_assert_eq!(whole.iter().collect::<Vec<_>>(), expected.clone());
            prop_assert_eq!((whole.lists(), whole.end()), (sizes.len(), sizes.iter().sum()));
            let same = sizes.windows(2).all(|two| two[0] == two[1]);
            let size = sizes.first().copied().unwrap_or(0);
            prop_assert_eq!(whole.size_of_all(), same.then_some(size));
            for (n, two) in expected.windows(2).enumerate() {
                let range = two[0] as usize..two[1] as usize;
                prop_assert_eq!(whole.range(n), Some(range.clone()));
                prop_assert!(range.clone().all(|place| whole.list_of(place) == n));
            }
            prop_assert_eq!(whole.range(sizes.len()), None);
        }
    }
}
