//! The values of an array: one vector of one of VTK's types.

use super::array_type::ArrayType;

/// The values of an array, tuple after tuple.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// `Int8`
    I8(Vec<i8>),
    /// `UInt8`
    U8(Vec<u8>),
    /// `Int16`
    I16(Vec<i16>),
    /// `UInt16`
    U16(Vec<u16>),
    /// `Int32`
    I32(Vec<i32>),
    /// `UInt32`
    U32(Vec<u32>),
    /// `Int64`
    I64(Vec<i64>),
    /// `UInt64`
    U64(Vec<u64>),
    /// `Float32`
    F32(Vec<f32>),
    /// `Float64`
    F64(Vec<f64>),
    /// `String`
    Strings(Vec<String>),
}

/// Runs one expression for whichever number vector is inside, another for strings.
macro_rules! match_values {
    ($values:expr, $vector:ident => $numbers:expr, $texts:ident => $strings:expr) => {
        match $values {
            $crate::vtk::values::Values::I8($vector) => $numbers,
            $crate::vtk::values::Values::U8($vector) => $numbers,
            $crate::vtk::values::Values::I16($vector) => $numbers,
            $crate::vtk::values::Values::U16($vector) => $numbers,
            $crate::vtk::values::Values::I32($vector) => $numbers,
            $crate::vtk::values::Values::U32($vector) => $numbers,
            $crate::vtk::values::Values::I64($vector) => $numbers,
            $crate::vtk::values::Values::U64($vector) => $numbers,
            $crate::vtk::values::Values::F32($vector) => $numbers,
            $crate::vtk::values::Values::F64($vector) => $numbers,
            $crate::vtk::values::Values::Strings($texts) => $strings,
        }
    };
}
pub(super) use match_values;

/// Runs one expression with `$scalar` standing for the number type of that tag,
/// another for `Bit` and `String`.
macro_rules! match_type {
    ($type:expr, $scalar:ident => $numbers:expr, other => $other:expr) => {
        match $type {
            $crate::vtk::array_type::ArrayType::I8 => {
                type $scalar = i8;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::U8 => {
                type $scalar = u8;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::I16 => {
                type $scalar = i16;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::U16 => {
                type $scalar = u16;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::I32 => {
                type $scalar = i32;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::U32 => {
                type $scalar = u32;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::I64 => {
                type $scalar = i64;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::U64 => {
                type $scalar = u64;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::F32 => {
                type $scalar = f32;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::F64 => {
                type $scalar = f64;
                $numbers
            }
            $crate::vtk::array_type::ArrayType::Bit
            | $crate::vtk::array_type::ArrayType::String => $other,
        }
    };
}
pub(super) use match_type;

impl Values {
    /// The number of values (not of tuples).
    pub fn len(&self) -> usize {
        match_values!(self, vector => vector.len(), texts => texts.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The type; never [`ArrayType::Bit`], which is decoded as `U8`.
    pub fn array_type(&self) -> ArrayType {
        use super::scalar::Scalar;
        fn tag<T: Scalar>(_: &[T]) -> ArrayType {
            T::TYPE
        }
        match_values!(self, vector => tag(vector), _texts => ArrayType::String)
    }

    /// Every value as `f64` (64-bit integers beyond 2^53 are rounded); `None` for strings.
    pub fn to_f64(&self) -> Option<Vec<f64>> {
        self.convert(0, 1)
    }

    /// Values `first`, `first + step`, ... as `f64`; `None` for strings.
    pub(super) fn convert(&self, first: usize, step: usize) -> Option<Vec<f64>> {
        use super::scalar::Scalar;
        fn every<T: Scalar>(vector: &[T], first: usize, step: usize) -> Vec<f64> {
            let picked = vector.iter().skip(first).step_by(step.max(1));
            picked.map(|value| value.to_f64()).collect()
        }
        match_values!(self, vector => Some(every(vector, first, step)), _texts => None)
    }

    /// Appends values of the same type; returns whether they are.
    pub(super) fn append(&mut self, more: Self) -> bool {
        macro_rules! append {
            ($($variant:ident)*) => {
                match (self, more) {
                    $((Self::$variant(values), Self::$variant(mut more)) => {
                        values.append(&mut more);
                        true
                    })*
                    _ => false,
                }
            };
        }
        append!(I8 U8 I16 U16 I32 U32 I64 U64 F32 F64 Strings)
    }

    /// The values of the ranges, one after the other; ranges that reach past the end are cut.
    pub(super) fn gather(&self, ranges: &[std::ops::Range<usize>]) -> Self {
        fn pick<T: Clone>(vector: &[T], ranges: &[std::ops::Range<usize>]) -> Vec<T> {
            let parts = ranges.iter().map(|range| {
                let end = range.end.min(vector.len());
                vector.get(range.start..end).unwrap_or_default()
            });
            parts.collect::<Vec<_>>().concat()
        }
        match_values!(self, vector => pick(vector, ranges).into(), texts => pick(texts, ranges).into())
    }
}

macro_rules! from_vector {
    ($($type:ty => $variant:ident),*) => {
        $(impl From<Vec<$type>> for Values {
            fn from(vector: Vec<$type>) -> Self {
                Values::$variant(vector)
            }
        })*
    };
}
from_vector!(i8 => I8, u8 => U8, i16 => I16, u16 => U16, i32 => I32, u32 => U32,
    i64 => I64, u64 => U64, f32 => F32, f64 => F64, String => Strings);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_and_conversion() {
        let values = Values::from(vec![1u8, 2, 255]);
        assert_eq!(values.array_type(), ArrayType::U8);
        assert_eq!(values.to_f64(), Some(vec![1.0, 2.0, 255.0]));
        let texts = Values::from(vec![String::from("a")]);
        assert_eq!(texts.array_type(), ArrayType::String);
        assert_eq!(texts.to_f64(), None);
    }

    #[test]
    fn values_of_the_same_type_are_appended() {
        let mut values = Values::from(vec![1u8, 2]);
        assert!(values.append(vec![3u8].into()));
        assert!(!values.append(vec![4i8].into()));
        assert_eq!(values, vec![1u8, 2, 3].into());
    }

    #[test]
    #[allow(clippy::single_range_in_vec_init)]
    fn gather_reorders_and_cuts() {
        let values = Values::from(vec![0i32, 1, 2, 3, 4]);
        assert_eq!(values.gather(&[3..5, 0..2]), vec![3i32, 4, 0, 1].into());
        assert_eq!(values.gather(&[4..9]), vec![4i32].into());
    }
}
