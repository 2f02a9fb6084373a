//! The cells of a legacy file, in the form before version 5 and in that since.

use super::cell_array::CellArray;
use super::error::ArrayError;
use super::legacy_array::{LegacyArray, LegacyCoding};
use super::legacy_scanner::{LegacyFlaw, Scanner};

/// The cells of one kind, of which only the place is known.
#[derive(Clone, Debug)]
pub(super) enum LegacyCells {
    /// Before version 5: each cell's number of points and these, one cell after the other.
    Stream { cells: usize, stream: LegacyArray },
    /// Since version 5: where each cell begins, and the points of all.
    Lists { offsets: LegacyArray, connectivity: LegacyArray },
}

impl LegacyCells {
    /// Finds the cells behind the keyword; its two numbers mean different things in the two
    /// forms.
    pub(super) fn scan(
        scanner: &mut Scanner<'_>,
        coding: LegacyCoding,
        is_new_form: bool,
    ) -> Result<Self, LegacyFlaw> {
        let first = scanner.count("the number of cells")?;
        let second = scanner.count("the size of the cells")?;
        if !is_new_form {
            let stream = LegacyArray::scan(scanner, coding, "cells", b"int", (second, 1))?;
            return Ok(Self::Stream { cells: first, stream });
        }
        let mut scan = |name: &'static str, count| {
            if first > 0 {
                scanner.expect(name)?;
            } else if !scanner.next_is(name) {
                return LegacyArray::scan(scanner, coding, name, b"int", (0, 1));
            }
            let kind = scanner.word("a type")?;
            LegacyArray::scan(scanner, coding, name, kind, (count, 1))
        };
        Ok(Self::Lists {
            offsets: scan("OFFSETS", first)?,
            connectivity: scan("CONNECTIVITY", second)?,
        })
    }

    /// The number of cells.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Stream { cells, .. } => *cells,
            Self::Lists { offsets, .. } => offsets.tuples.saturating_sub(1),
        }
    }

    /// Decodes the cells. The indices are not checked: polyhedra have other numbers, too.
    pub(super) fn decode(&self, bytes: &[u8]) -> Result<CellArray, ArrayError> {
        match self {
            Self::Stream { cells, stream } => decode_stream(bytes, *cells, stream),
            Self::Lists { offsets, connectivity } => {
                let mut offsets = indices(bytes, offsets)?;
                if offsets.is_empty() {
                    offsets.push(0);
                }
                CellArray::from_parts(offsets, indices(bytes, connectivity)?)
            }
        }
    }
}

fn indices(bytes: &[u8], array: &LegacyArray) -> Result<Vec<i64>, ArrayError> {
    let mut values = Vec::with_capacity(array.tuples);
    array.for_each_index(bytes, |value| {
        values.push(value);
        Ok(())
    })?;
    Ok(values)
}

/// Takes lists out of a stream of lengths and values, which has one length a cell.
fn decode_stream(
    bytes: &[u8],
    cells: usize,
    stream: &LegacyArray,
) -> Result<CellArray, ArrayError> {
    let wrong = |found| ArrayError::Count { found, expected: stream.tuples };
    let values = stream.tuples.checked_sub(cells).ok_or_else(|| wrong(cells))?;
    let mut offsets = Vec::with_capacity(cells + 1);
    let mut connectivity = Vec::with_capacity(values);
    let mut end = 0i64;
    offsets.push(0);
    stream.for_each_index(bytes, |value| {
        if (connectivity.len() as i64) < end {
            connectivity.push(value);
            return Ok(());
        }
        let rising = Some(value).filter(|value| *value >= 0 && offsets.len() <= cells);
        end = rising.and_then(|value| end.checked_add(value)).ok_or_else(|| no_index(value))?;
        offsets.push(end);
        Ok(())
    })?;
    match offsets.len() == cells + 1 && end == connectivity.len() as i64 {
        true => CellArray::from_parts(offsets, connectivity),
        false => Err(wrong(connectivity.len().saturating_add(offsets.len() - 1))),
    }
}

fn no_index(value: i64) -> ArrayError {
    ArrayError::NoIndex { value: value.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, is_new_form: bool) -> Result<CellArray, String> {
        let mut scanner = Scanner::new(text.as_bytes());
        let cells = LegacyCells::scan(&mut scanner, LegacyCoding::Ascii, is_new_form);
        let cells = cells.map_err(|flaw| flaw.problem.to_string())?;
        cells.decode(text.as_bytes()).map_err(|problem| problem.to_string())
    }

    #[test]
    fn both_forms_give_the_same_lists() {
        let old = read("3 8\n3 0 1 2\n0\n2 4 3\n", false).unwrap();
        let new =
            read("4 5 OFFSETS int 0 3 3 5 CONNECTIVITY vtktypeint64 0 1 2 4 3", true).unwrap();
        assert_eq!(old, new);
        assert!(old.offsets().eq([0, 3, 3, 5]));
        assert_eq!(read("0 0", false).unwrap(), CellArray::new());
        assert_eq!(read("0 0", true).unwrap(), CellArray::new());
        assert_eq!(read("1 0 OFFSETS int 0 CONNECTIVITY int", true).unwrap(), CellArray::new());
    }

    #[test]
    fn contradictions_are_refused() {
        for text in ["2 4 3 0 1 2", "1 5 3 0 1 2 0", "1 3 3 0 1", "1 2 -1 0", "3 2 0 0", "1 2 1 x"]
        {
            assert!(read(text, false).is_err(), "{text}");
        }
        for text in ["2 2 OFFSETS int 0 3 CONNECTIVITY int 0 1", "2 2 0 2 0 1", "2 1 OFFSETS float"]
        {
            assert!(read(text, true).is_err(), "{text}");
        }
    }
}
