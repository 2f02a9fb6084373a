//! The values of one array on their way into a file.

use super::array_type::ArrayType;
use super::scalar::Scalar;
use super::values::{Values, match_values};
use super::write_options::Floats;
use std::borrow::Cow;
use std::marker::PhantomData;
use std::ops::Range;

/// The values of one array on their way into a file, piecemeal, so that converting them
/// never takes a second copy of the whole. Ranges count values and lie within `len`.
pub(super) trait Column: Sync {
    /// The type in the file.
    fn array_type(&self) -> ArrayType;

    /// How many values (bytes, for strings).
    fn len(&self) -> usize;

    /// Bytes of one value.
    fn value_size(&self) -> usize;

    /// Little-endian bytes.
    fn bytes(&self, range: Range<usize>) -> Cow<'_, [u8]>;

    /// Appends the values as text, one space before each.
    fn text(&self, range: Range<usize>, out: &mut Vec<u8>);
}

/// The column of an array's values.
pub(super) fn column(values: &Values, floats: Floats) -> Box<dyn Column + '_> {
    match (values, floats) {
        (Values::F64(vector), Floats::Single) => Box::new(Converted::<f64, f32>::new(vector)),
        (Values::F32(vector), Floats::Double) => Box::new(Converted::<f32, f64>::new(vector)),
        _ => match_values!(values, vector => Box::new(numbers(&vector[..])), texts => {
            Box::new(Texts::new(texts))
        }),
    }
}

/// The column of a slice or vector of numbers.
pub(super) fn numbers<'a, T: Scalar>(numbers: impl Into<Cow<'a, [T]>>) -> Numbers<'a, T> {
    Numbers(numbers.into())
}

/// Numbers as they are.
pub(super) struct Numbers<'a, T: Clone>(Cow<'a, [T]>);

impl<T: Scalar> Column for Numbers<'_, T> {
    fn array_type(&self) -> ArrayType {
        T::TYPE
    }

    fn len(&self) -> usize {
        self.0.len()
    }

    fn value_size(&self) -> usize {
        size_of::<T>()
    }

    fn bytes(&self, range: Range<usize>) -> Cow<'_, [u8]> {
        let numbers = self.0.get(range).unwrap_or_default();
        if cfg!(target_endian = "little") || size_of::<T>() == 1 {
            return Cow::Borrowed(bytemuck::cast_slice(numbers));
        }
        let turned: Vec<T> = numbers.iter().map(|number| number.swap_bytes()).collect();
        Cow::Owned(bytemuck::cast_slice(&turned).to_vec())
    }

    fn text(&self, range: Range<usize>, out: &mut Vec<u8>) {
        for number in self.0.get(range).unwrap_or_default() {
            out.push(b' ');
            number.format(out);
        }
    }
}

/// Floats in another precision.
struct Converted<'a, T, D> {
    source: &'a [T],
    dest: PhantomData<D>,
}

impl<'a, T, D> Converted<'a, T, D> {
    fn new(source: &'a [T]) -> Self {
        Self { source, dest: PhantomData }
    }
}

/// A float that can be made from an `f64`, rounded.
trait Rounded: Scalar {
    fn rounded(value: f64) -> Self;
}

impl Rounded for f32 {
    fn rounded(value: f64) -> Self {
        value as f32
    }
}

impl Rounded for f64 {
    fn rounded(value: f64) -> Self {
        value
    }
}

impl<T: Scalar, D: Rounded> Converted<'_, T, D> {
    fn convert(&self, range: Range<usize>) -> Numbers<'static, D> {
        let source = self.source.get(range).unwrap_or_default();
        let round = |value: &T| D::rounded(value.to_f64());
        numbers(source.iter().map(round).collect::<Vec<D>>())
    }
}

impl<T: Scalar, D: Rounded> Column for Converted<'_, T, D> {
    fn array_type(&self) -> ArrayType {
        D::TYPE
    }

    fn len(&self) -> usize {
        self.source.len()
    }

    fn value_size(&self) -> usize {
        size_of::<D>()
    }

    fn bytes(&self, range: Range<usize>) -> Cow<'_, [u8]> {
        let part = self.convert(range);
        Cow::Owned(part.bytes(0..part.len()).into_owned())
    }

    fn text(&self, range: Range<usize>, out: &mut Vec<u8>) {
        let part = self.convert(range);
        part.text(0..part.len(), out);
    }
}

/// Strings as bytes, each ended by a zero.
struct Texts(Vec<u8>);

impl Texts {
    fn new(texts: &[String]) -> Self {
        let ended = texts.iter().map(|text| {
            // A zero inside would end the string for every reader.
            let bytes = text.bytes().filter(|byte| *byte != 0);
            bytes.chain([0])
        });
        Self(ended.flatten().collect())
    }
}

impl Column for Texts {
    fn array_type(&self) -> ArrayType {
        ArrayType::String
    }

    fn len(&self) -> usize {
        self.0.len()
    }

    fn value_size(&self) -> usize {
        1
    }

    fn bytes(&self, range: Range<usize>) -> Cow<'_, [u8]> {
        Cow::Borrowed(self.0.get(range).unwrap_or_default())
    }

    fn text(&self, range: Range<usize>, out: &mut Vec<u8>) {
        // VTK writes the codes as signed numbers.
        let codes: Vec<i8> = self.bytes(range).iter().map(|byte| *byte as i8).collect();
        numbers(&codes[..]).text(0..codes.len(), out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(column: &dyn Column) -> String {
        let mut out = Vec::new();
        column.text(0..column.len(), &mut out);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn numbers_as_bytes_and_text() {
        let values = Values::from(vec![1u16, 256]);
        let column = column(&values, Floats::Single);
        assert_eq!(column.bytes(0..2)[..], [1, 0, 0, 1]);
        assert_eq!(column.bytes(1..2)[..], [0, 1]);
        assert_eq!(text(&*column), " 1 256");
        assert_eq!(column.array_type(), ArrayType::U16);
    }

    #[test]
    fn floats_in_another_precision() {
        let values = Values::from(vec![0.1f64, 1e300]);
        let single = column(&values, Floats::Single);
        assert_eq!((single.array_type(), single.value_size()), (ArrayType::F32, 4));
        assert_eq!(text(&*single), " 0.1 inf");
        assert_eq!(text(&*column(&values, Floats::Double)), " 0.1 1e300");
        let values = Values::from(vec![0.5f32]);
        let double = column(&values, Floats::Double);
        assert_eq!(double.bytes(0..1)[..], 0.5f64.to_le_bytes());
    }

    #[test]
    fn strings_end_with_zero() {
        let values = Values::from(vec![String::from("é"), String::from("a\0b")]);
        let column = column(&values, Floats::AsGiven);
        assert_eq!(column.bytes(0..6)[..], *b"\xC3\xA9\0ab\0");
        assert_eq!(text(&*column), " -61 -87 0 97 98 0");
    }
}
