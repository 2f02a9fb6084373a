//! One array over all pieces of a file: opened and checked, then decoded.

use super::array_head::ArrayHead;
use super::array_type::ArrayType;
use super::data_array::DataArray;
use super::error::{ArrayError, VtkError};
use super::payload::Payload;
use super::scalar::Scalar;
use super::values::{Values, match_type};
use super::xml_file::{Budget, XmlFile};
use crate::large_pages;

/// Bytes that an array of unknown length may have besides four times its file.
const UNBOUNDED: usize = 16 << 20;

/// One array over all pieces, of which nothing has been read but the head.
#[derive(Clone)]
pub(super) struct JoinedArray<'a> {
    pub(super) name: String,
    pub(super) array_type: ArrayType,
    pub(super) components: usize,
    pub(super) component_names: Vec<String>,
    /// The array in every piece that has tuples.
    pub(super) parts: Vec<PartHead<'a>>,
}

/// One array in one piece, of which nothing has been read but the head.
#[derive(Clone)]
pub(super) struct PartHead<'a> {
    pub(super) file: &'a XmlFile,
    pub(super) head: ArrayHead<'a>,
    /// How many tuples; `None` where only the data can tell.
    pub(super) tuples: Option<usize>,
}

/// What is wrong with an array, and in which file.
pub(super) struct Flaw<'a> {
    pub(super) file: &'a XmlFile,
    pub(super) problem: ArrayError,
}

impl Flaw<'_> {
    /// Whether the array is of the wrong length: then it can be left out.
    pub(super) fn is_of_length(&self) -> bool {
        matches!(self.problem, ArrayError::Count { .. } | ArrayError::NoCount { .. })
    }

    /// The error with its place.
    pub(super) fn into_error(self, section: &str, name: &str) -> VtkError {
        self.file.array_error(section, name, self.problem)
    }
}

impl<'a> JoinedArray<'a> {
    /// An array shaped like `head`, still without parts.
    pub(super) fn like(head: &ArrayHead<'a>) -> Result<Self, ArrayError> {
        let (array_type, components) = head.shape.clone()?;
        Ok(Self {
            name: head.name.clone(),
            array_type,
            components,
            component_names: head.component_names.clone(),
            parts: Vec::new(),
        })
    }

    /// Reads the headers of all parts and checks that they promise the right lengths.
    pub(super) fn open(self, budget: &mut Budget) -> Result<OpenArray<'a>, Flaw<'a>> {
        let mut parts = Vec::with_capacity(self.parts.len());
        for part in &self.parts {
            let open = self.open_part(part, budget);
            parts.push(open.map_err(|problem| Flaw { file: part.file, problem })?);
        }
        Ok(OpenArray { head: self, parts })
    }

    fn open_part(&self, part: &PartHead<'a>, budget: &mut Budget) -> Result<Part<'a>, ArrayError> {
        let payload = part.file.payload(part.head.node, budget)?;
        let count = part.tuples.map(|tuples| tuples.checked_mul(self.components));
        let count = count.map(|count| count.unwrap_or(usize::MAX));
        let part = Part { file: part.file, payload, count };
        part.check(self.array_type)?;
        Ok(part)
    }
}

/// The encoded values of one piece, and how many there must be.
struct Part<'a> {
    file: &'a XmlFile,
    payload: Payload<'a>,
    count: Option<usize>,
}

impl<'a> Part<'a> {
    /// Adds the file to what is wrong.
    fn flaw(&self) -> impl Fn(ArrayError) -> Flaw<'a> + use<'a> {
        let file = self.file;
        move |problem| Flaw { file, problem }
    }

    /// Refuses compressed data far larger than the file where nothing says how many there
    /// must be: no sane file holds them, and VTK takes such arrays for empty.
    fn check_unbounded(&self) -> Result<(), ArrayError> {
        let bytes = if self.payload.is_ascii() { 0 } else { self.payload.count(1)? };
        match bytes > self.file.len().saturating_mul(4).saturating_add(UNBOUNDED) {
            true => Err(ArrayError::NoCount { bytes }),
            false => Ok(()),
        }
    }

    /// Refuses another number of values than there must be, before anything is allocated.
    fn check(&self, kind: ArrayType) -> Result<(), ArrayError> {
        let Some(expected) = self.count else {
            return self.check_unbounded();
        };
        let size_of = match_type!(kind, T => size_of::<T>(), other => 1);
        let found = self.payload.count(size_of)?;
        let expected = match kind {
            ArrayType::Bit if !self.payload.is_ascii() => expected.div_ceil(8),
            // Only the decoded bytes tell how many strings they hold; each ends with 0.
            ArrayType::String if found >= expected => found,
            _ => expected,
        };
        match found == expected {
            true => Ok(()),
            false => Err(ArrayError::Count { found, expected }),
        }
    }
}

/// One array over all pieces, headers checked.
pub(super) struct OpenArray<'a> {
    pub(super) head: JoinedArray<'a>,
    parts: Vec<Part<'a>>,
}

impl<'a> OpenArray<'a> {
    /// Decodes all parts, one after the other, into one array.
    pub(super) fn decode(self) -> Result<DataArray, Flaw<'a>> {
        let values = match self.head.array_type {
            ArrayType::Bit => Values::U8(self.collect(bits)?),
            ArrayType::String => Values::Strings(self.collect(strings)?),
            kind => match_type!(kind, T => T::into_values(self.numbers::<T>()?), other => {
                Values::U8(Vec::new())
            }),
        };
        let (found, components) = (values.len(), self.head.components);
        if let Some(part) = self.parts.first().filter(|_| !found.is_multiple_of(components)) {
            let expected = found - found % components;
            return Err(part.flaw()(ArrayError::Count { found, expected }));
        }
        Ok(DataArray {
            name: self.head.name,
            components,
            component_names: self.head.component_names,
            values,
        })
    }

    /// Numbers are decoded in place, without a copy.
    fn numbers<T: Scalar>(&self) -> Result<Vec<T>, Flaw<'a>> {
        let mut counts = Vec::with_capacity(self.parts.len());
        let mut total = 0usize;
        for part in &self.parts {
            let count = part.payload.count(size_of::<T>()).map_err(part.flaw())?;
            let too_many = ArrayError::Count { found: usize::MAX, expected: 0 };
            total = total.checked_add(count).ok_or(too_many).map_err(part.flaw())?;
            counts.push(count);
        }
        let mut values = large_pages::zeros(total);
        let mut rest = &mut values[..];
        for (part, count) in self.parts.iter().zip(counts) {
            let (dest, after) = rest.split_at_mut(count);
            part.payload.decode(dest).map_err(part.flaw())?;
            rest = after;
        }
        Ok(values)
    }

    fn collect<V>(
        &self,
        read: impl Fn(&Part<'_>) -> Result<Vec<V>, ArrayError>,
    ) -> Result<Vec<V>, Flaw<'a>> {
        let mut values = Vec::new();
        for part in &self.parts {
            values.append(&mut read(part).map_err(part.flaw())?);
        }
        Ok(values)
    }
}

/// The bits of a part, each as 0 or 1.
fn bits(part: &Part<'_>) -> Result<Vec<u8>, ArrayError> {
    let bytes = part.payload.to_vec::<u8>()?;
    if part.payload.is_ascii() {
        return Ok(bytes);
    }
    let count = part.count.unwrap_or(bytes.len().saturating_mul(8));
    let bit = |index: usize| bytes.get(index / 8).map(|byte| byte >> (7 - index % 8) & 1);
    Ok((0..count).map_while(bit).collect())
}

/// The zero-terminated strings of a part.
fn strings(part: &Part<'_>) -> Result<Vec<String>, ArrayError> {
    let bytes = match part.payload.is_ascii() {
        // Written as numbers, by VTK as signed ones, by others as unsigned.
        true => codes(&part.payload.to_vec::<i16>()?),
        false => part.payload.to_vec::<u8>()?,
    };
    let mut texts: Vec<String> = bytes
        .split(|byte| *byte == 0)
        .map(|text| String::from_utf8_lossy(text).into_owned())
        .collect();
    if texts.last().is_some_and(String::is_empty) {
        texts.pop();
    }
    match part.count {
        Some(expected) if expected != texts.len() => {
            Err(ArrayError::Count { found: texts.len(), expected })
        }
        _ => Ok(texts),
    }
}

fn codes(numbers: &[i16]) -> Vec<u8> {
    numbers.iter().map(|number| *number as u8).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::vtk::file_bytes::FileBytes;
    use std::path::Path;
    use std::sync::LazyLock;

    static FILE: LazyLock<XmlFile> = LazyLock::new(|| {
        let bytes = FileBytes::Owned(b"<VTKFile type='x'/>".to_vec());
        XmlFile::parse(Path::new("x"), bytes, "x").unwrap()
    });

    fn part(text: &str, count: Option<usize>) -> Part<'_> {
        Part { file: &FILE, payload: Payload::ascii(text.as_bytes(), 0), count }
    }

    #[test]
    fn strings_end_with_zero_and_may_be_empty() {
        let texts = strings(&part("104 -61 -87 0 0 98 0", Some(3))).unwrap();
        assert_eq!(texts, ["hé", "", "b"]);
        assert_eq!(strings(&part("195 169", None)).unwrap(), ["é"]);
        assert!(strings(&part("", None)).unwrap().is_empty());
        assert!(strings(&part("98 0", Some(2))).is_err());
    }

    #[test]
    fn wrong_counts_are_refused_before_decoding() {
        let error = part("1 2 x", Some(4)).check(ArrayType::I8).unwrap_err();
        assert_eq!(error, ArrayError::Count { found: 3, expected: 4 });
        assert!(part("1 2 x", Some(3)).check(ArrayType::I8).is_ok());
    }
}
