//! One array over all pieces of a file: opened and checked, then decoded.

use super::array_head::ArrayHead;
use super::array_type::ArrayType;
use super::data_array::DataArray;
use super::error::ArrayError;
use super::payload::Payload;
use super::scalar::Scalar;
use super::values::{Values, match_type};
use super::xml_file::{Budget, XmlFile};

/// One array over all pieces, of which nothing has been read but the head.
#[derive(Clone)]
pub(super) struct JoinedArray<'a> {
    pub(super) name: String,
    pub(super) array_type: ArrayType,
    pub(super) components: usize,
    pub(super) component_names: Vec<String>,
    /// The array in every piece that has tuples, and how many; `None` where only the
    /// data can tell.
    pub(super) parts: Vec<(ArrayHead<'a>, Option<usize>)>,
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
    pub(super) fn open(
        self,
        file: &'a XmlFile,
        budget: &mut Budget,
    ) -> Result<OpenArray<'a>, ArrayError> {
        let mut parts = Vec::with_capacity(self.parts.len());
        for (head, tuples) in &self.parts {
            let payload = file.payload(head.node, budget)?;
            let tuples = tuples.map(|tuples| tuples.checked_mul(self.components));
            let part = Part { payload, count: tuples.map(|count| count.unwrap_or(usize::MAX)) };
            part.check(self.array_type)?;
            parts.push(part);
        }
        Ok(OpenArray { head: self, parts })
    }
}

/// The encoded values of one piece, and how many there must be.
struct Part<'a> {
    payload: Payload<'a>,
    count: Option<usize>,
}

impl Part<'_> {
    /// Refuses another number of values than there must be, before anything is allocated.
    fn check(&self, kind: ArrayType) -> Result<(), ArrayError> {
        let Some(expected) = self.count else {
            return Ok(());
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

impl OpenArray<'_> {
    /// Decodes all parts, one after the other, into one array.
    pub(super) fn decode(self) -> Result<DataArray, ArrayError> {
        let values = match self.head.array_type {
            ArrayType::Bit => Values::U8(self.collect(bits)?),
            ArrayType::String => Values::Strings(self.collect(strings)?),
            kind => match_type!(kind, T => T::into_values(self.numbers::<T>()?), other => {
                return Err(ArrayError::UnknownType(kind.name().to_owned()))
            }),
        };
        let (found, components) = (values.len(), self.head.components);
        if !found.is_multiple_of(components) {
            let expected = found - found % components;
            return Err(ArrayError::Count { found, expected });
        }
        Ok(DataArray {
            name: self.head.name,
            components,
            component_names: self.head.component_names,
            values,
        })
    }

    /// Numbers are decoded in place, without a copy.
    fn numbers<T: Scalar>(&self) -> Result<Vec<T>, ArrayError> {
        let mut counts = Vec::with_capacity(self.parts.len());
        for part in &self.parts {
            counts.push(part.payload.count(size_of::<T>())?);
        }
        let total = counts.iter().try_fold(0usize, |sum, n| sum.checked_add(*n));
        let too_many = ArrayError::Count { found: usize::MAX, expected: 0 };
        let mut values = vec![T::zeroed(); total.ok_or(too_many)?];
        let mut rest = &mut values[..];
        for (part, count) in self.parts.iter().zip(counts) {
            let (dest, after) = rest.split_at_mut(count);
            part.payload.decode(dest)?;
            rest = after;
        }
        Ok(values)
    }

    fn collect<V>(
        &self,
        read: impl Fn(&Part<'_>) -> Result<Vec<V>, ArrayError>,
    ) -> Result<Vec<V>, ArrayError> {
        let mut values = Vec::new();
        for part in &self.parts {
            values.extend(read(part)?);
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

    fn part(text: &str, count: Option<usize>) -> Part<'_> {
        Part { payload: Payload::ascii(text.as_bytes(), 0), count }
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
