//! Cells of all pieces, joined: offsets first, then the connectivity they measure.

use super::array_head::ArrayHead;
use super::cell_array::{CellArray, first_outside};
use super::error::{ArrayError, VtkError};
use super::offsets::{Offsets, common_difference};
use super::payload::Payload;
use super::scalar::Scalar;
use super::values::match_type;
use super::xml::Node;
use super::xml_file::{Budget, XmlFile};
use crate::large_pages;

/// The names of the two arrays that hold lists of indices.
#[derive(Clone, Copy)]
pub(super) struct ListNames {
    pub(super) connectivity: &'static str,
    pub(super) offsets: &'static str,
}

/// The names for the points of cells.
pub(super) const CELLS: ListNames = ListNames { connectivity: "connectivity", offsets: "offsets" };

/// Where the lists of one piece are.
pub(super) struct ListSource<'a> {
    pub(super) file: &'a XmlFile,
    /// The element that holds the arrays, such as `<Cells>`; `None` where it is missing.
    pub(super) section: Option<Node<'a>>,
    /// What messages call it.
    pub(super) label: String,
    /// How many lists; `None` where only the data can tell.
    pub(super) count: Option<usize>,
    /// Every index is below this.
    pub(super) bound: usize,
}

impl ListSource<'_> {
    fn error(&self, name: &str, problem: ArrayError) -> VtkError {
        self.file.array_error(&self.label, name, problem)
    }
}

/// An array of integers, header checked.
pub(super) struct Integers<'a> {
    payload: Payload<'a>,
    head: ArrayHead<'a>,
    count: usize,
}

impl<'a> Integers<'a> {
    /// Finds the array in a section and checks its header. The number of values is
    /// `expected`, or what the header says.
    pub(super) fn open(
        file: &'a XmlFile,
        section: Option<Node<'a>>,
        name: &str,
        expected: Option<usize>,
        budget: &mut Budget,
    ) -> Result<Self, ArrayError> {
        let heads = section.into_iter().flat_map(ArrayHead::all_in);
        let head = heads.into_iter().find(|head| head.name == name);
        let head = head.ok_or(ArrayError::Missing)?;
        let (kind, _) = head.shape.clone()?;
        let not_integer = ArrayError::WrongType { found: kind, expected: "an integer" };
        if kind.is_float() {
            return Err(not_integer);
        }
        let payload = file.payload(head.node, budget)?;
        let size = match_type!(kind, T => size_of::<T>(), other => return Err(not_integer));
        let found = payload.count(size)?;
        let count = expected.unwrap_or(found);
        match found == count {
            true => Ok(Self { payload, head, count }),
            false => Err(ArrayError::Count { found, expected: count }),
        }
    }

    /// How many values there are.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The size of all lists of which these are the ends, if they have the same: seen without being
    /// kept. Nothing where that cannot be seen in the file as it is.
    fn size_of_lists(&self) -> Option<usize> {
        let bytes = self.payload.as_it_is()?;
        let (kind, _) = self.head.shape.clone().ok()?;
        match_type!(kind, T => size_of_lists::<T>(bytes), other => None)
    }

    /// Decodes into `dest`; numbers of that type are decoded in place.
    pub(super) fn decode<D>(&self, dest: &mut [D]) -> Result<(), ArrayError>
    where
        D: Scalar + TryFrom<i64>,
    {
        let (kind, _) = self.head.shape.clone()?;
        if kind == D::TYPE {
            return self.payload.decode(dest);
        }
        match_type!(kind, T => convert(&self.payload.to_vec::<T>()?, dest), other => {
            Err(ArrayError::UnknownType(kind.name().to_owned()))
        })
    }
}

/// The size of all lists whose ends have these bytes.
fn size_of_lists<T: Scalar>(bytes: &[u8]) -> Option<usize> {
    let number = |bytes: &[u8]| bytemuck::pod_read_unaligned::<T>(bytes).to_i64();
    common_difference(bytes.chunks_exact(size_of::<T>()).map(number))
}

fn convert<T: Scalar, D: TryFrom<i64>>(source: &[T], dest: &mut [D]) -> Result<(), ArrayError> {
    for (to, from) in dest.iter_mut().zip(source) {
        let number = from.to_i64().and_then(|number| D::try_from(number).ok());
        *to = number.ok_or_else(|| ArrayError::NoIndex { value: from.to_f64().to_string() })?;
    }
    Ok(())
}

/// Reads the lists of all pieces into one array. The indices of each piece are moved by
/// the bounds of those before it, as their points are.
pub(super) fn read_lists(
    names: ListNames,
    sources: &[ListSource<'_>],
    budget: &mut Budget,
) -> Result<CellArray, VtkError> {
    let (offsets, totals) = read_offsets(names, sources, budget)?;
    let mut parts = Vec::with_capacity(sources.len());
    for (source, total) in sources.iter().zip(&totals) {
        let open = open_values(source, names.connectivity, *total, budget);
        parts.push(open.map_err(|e| source.error(names.connectivity, e))?);
    }
    let mut connectivity = large_pages::zeros(offsets.end());
    let mut rest = &mut connectivity[..];
    let mut shift = 0;
    for ((source, part), total) in sources.iter().zip(parts).zip(totals) {
        let (dest, after) = rest.split_at_mut(total);
        let decoded = decode_values(part, dest, source.bound, shift);
        decoded.map_err(|e| source.error(names.connectivity, e))?;
        source.file.release();
        rest = after;
        shift += source.bound;
    }
    Ok(CellArray::from_offsets(offsets, connectivity).expect("as many values as offsets say"))
}

/// The offsets of all pieces, and the connectivity's length in each.
fn read_offsets(
    names: ListNames,
    sources: &[ListSource<'_>],
    budget: &mut Budget,
) -> Result<(Offsets, Vec<usize>), VtkError> {
    let name = names.offsets;
    let mut parts = Vec::with_capacity(sources.len());
    for source in sources {
        let open = match source.count {
            Some(0) => Ok(None),
            count => Integers::open(source.file, source.section, name, count, budget).map(Some),
        };
        parts.push(open.map_err(|e| source.error(name, e))?);
    }
    let mut all = Offsets::none();
    let mut totals = Vec::with_capacity(sources.len());
    for (source, part) in sources.iter().zip(parts) {
        let of_piece = part.map_or(Ok(Offsets::none()), |part| decode_offsets(&part));
        let of_piece = of_piece.map_err(|e| source.error(name, e))?;
        let last = of_piece.end();
        let end = all.end().checked_add(last).and_then(|end| i64::try_from(end).ok());
        let too_large = || ArrayError::NoIndex { value: last.to_string() };
        end.ok_or_else(|| source.error(name, too_large()))?;
        totals.push(last);
        match all.lists() {
            0 => all = of_piece,
            _ => all.append(&of_piece),
        }
        source.file.release();
    }
    Ok((all, totals))
}

/// The offsets of a piece, of which the array leaves out the leading 0.
fn decode_offsets(part: &Integers<'_>) -> Result<Offsets, ArrayError> {
    if let Some(size) = part.size_of_lists() {
        return Ok(Offsets::regular(part.count(), size));
    }
    let mut offsets = large_pages::zeros::<i64>(part.count() + 1);
    part.decode(&mut offsets[1..])?;
    match offsets.get(1).filter(|first| **first < 0) {
        Some(first) => Err(ArrayError::NoIndex { value: first.to_string() }),
        None => Offsets::from_vec(offsets),
    }
}

/// Opens the values of lists; none are looked for where there are none.
fn open_values<'a>(
    source: &ListSource<'a>,
    name: &str,
    total: usize,
    budget: &mut Budget,
) -> Result<Option<Integers<'a>>, ArrayError> {
    match total {
        0 => Ok(None),
        _ => Integers::open(source.file, source.section, name, Some(total), budget).map(Some),
    }
}

/// Decodes the values of lists, checks that they are below `bound`, and moves them.
fn decode_values(
    part: Option<Integers<'_>>,
    dest: &mut [i64],
    bound: usize,
    shift: usize,
) -> Result<(), ArrayError> {
    let Some(part) = part else {
        return Ok(());
    };
    part.decode(dest)?;
    if let Some(at) = first_outside(dest, bound) {
        return Err(ArrayError::OutOfRange {
            at,
            index: dest.get(at).copied().unwrap_or(0),
            count: bound,
        });
    }
    if shift > 0 {
        // Bounds add up to the number of points, which is an i64.
        dest.iter_mut().for_each(|index| *index += shift as i64);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::file_bytes::FileBytes;
    use std::path::Path;

    #[test]
    fn lists_of_one_size_are_seen_in_the_bytes_of_their_ends() {
        fn found<T: Scalar>(ends: &[T]) -> Option<usize> {
            // not aligned
            let bytes = [&[0], bytemuck::cast_slice(ends)].concat();
            size_of_lists::<T>(&bytes[1..])
        }
        assert_eq!(found(&[4_i64, 8, 12]), Some(4));
        assert_eq!(found(&[7_u32]), Some(7));
        assert_eq!(found(&[0_i64, 0]), Some(0));
        assert_eq!(found(&[100_u8, 200]), Some(100));
        assert_eq!(found::<i64>(&[]), None);
        for others in
            [[4, 8, 13], [4, 9, 12], [3, 8, 12], [-4, -8, -12], [0, 0, 1], [i64::MAX, -2, 1]]
        {
            assert_eq!(found(&others), None, "{others:?}");
        }
        assert_eq!(found(&[u64::MAX, u64::MAX - 1]), None);
    }

    /// Reads lists of pieces, each given as (number of lists, bound, arrays).
    fn read(pieces: &[(Option<usize>, usize, &str)]) -> Result<CellArray, VtkError> {
        let sections: String = pieces.iter().map(|p| format!("<Cells>{}</Cells>", p.2)).collect();
        let text = format!("<VTKFile type='x'><x>{sections}</x></VTKFile>");
        let bytes = FileBytes::Owned(text.into_bytes());
        let file = XmlFile::parse(Path::new("x.vtu"), bytes, "x")?;
        let nodes = file.data_set()?.children();
        let sources: Vec<_> = nodes
            .zip(pieces)
            .map(|(node, (count, bound, _))| ListSource {
                file: &file,
                section: Some(node),
                label: String::from("Cells"),
                count: *count,
                bound: *bound,
            })
            .collect();
        read_lists(CELLS, &sources, &mut Budget::of(&[&file]))
    }

    fn arrays(kind: &str, connectivity: &str, offsets: &str) -> String {
        format!(
            "<DataArray type='{kind}' Name='connectivity'>{connectivity}</DataArray>\
             <DataArray type='{kind}' Name='offsets'>{offsets}</DataArray>"
        )
    }

    #[test]
    fn pieces_are_moved_past_each_other() {
        for kind in ["Int64", "Int32", "UInt8", "UInt64"] {
            let one = arrays(kind, "0 1 2 2", "3 3 4");
            let two = arrays(kind, "1 0", "2");
            let pieces = [(Some(3), 3, &one[..]), (Some(0), 5, ""), (None, 2, &two)];
            let lists = read(&pieces).unwrap();
            assert!(lists.offsets().eq([0, 3, 3, 4, 6]), "{kind}");
            assert_eq!(lists.connectivity(), [0, 1, 2, 2, 9, 8], "{kind}");
        }
    }

    #[test]
    fn bad_cells_are_refused() {
        let message = |kind: &str, connectivity: &str, offsets: &str| {
            let arrays = arrays(kind, connectivity, offsets);
            read(&[(Some(2), 3, &arrays)]).unwrap_err().to_string()
        };
        assert!(message("Int32", "0 1 3", "1 3").contains("3, outside 0..3"));
        assert!(message("Int32", "0 -1 2", "1 3").contains("-1, outside"));
        assert!(message("Int32", "0 1 2", "3 1").contains("smaller than the one before"));
        assert!(message("Int32", "0 1 2", "-1 3").contains("-1 is no index"));
        assert!(message("Int32", "0 1 2", "1 4").contains("3 values where 4"));
        assert!(message("Int32", "0 1 2", "1 2 3").contains("3 values where 2"));
        assert!(message("Float32", "0 1 2", "1 3").contains("an integer"));
        assert!(message("UInt64", "0 1 2", "1 18446744073709551615").contains("no index"));
        assert!(message("Int64", "0 1 2", "1 9223372036854775807").contains("3 values where"));
        let endless = arrays("Int64", "0", "9223372036854775807");
        let two = read(&[(Some(1), 3, &endless), (Some(1), 3, &endless)]).unwrap_err().to_string();
        assert!(two.contains("9223372036854775807 is no index"), "{two}");
        let missing = read(&[(Some(1), 3, "")]).unwrap_err().to_string();
        assert!(missing.contains("'offsets' of Cells: it is missing"), "{missing}");
    }
}
