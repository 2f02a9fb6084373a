//! The type of an array's values, as VTK names it.

use std::fmt;

/// The type of an array's values, as VTK's XML files name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ArrayType {
    /// `Int8`
    I8,
    /// `UInt8`
    U8,
    /// `Int16`
    I16,
    /// `UInt16`
    U16,
    /// `Int32`
    I32,
    /// `UInt32`
    U32,
    /// `Int64`
    I64,
    /// `UInt64`
    U64,
    /// `Float32`
    F32,
    /// `Float64`
    F64,
    /// `Bit`: eight values a byte, the first in the highest bit; decoded as `U8`.
    Bit,
    /// `String`: zero-terminated texts.
    String,
}

/// Every type with its name in a file.
const NAMES: [(ArrayType, &str); 12] = [
    (ArrayType::I8, "Int8"),
    (ArrayType::U8, "UInt8"),
    (ArrayType::I16, "Int16"),
    (ArrayType::U16, "UInt16"),
    (ArrayType::I32, "Int32"),
    (ArrayType::U32, "UInt32"),
    (ArrayType::I64, "Int64"),
    (ArrayType::U64, "UInt64"),
    (ArrayType::F32, "Float32"),
    (ArrayType::F64, "Float64"),
    (ArrayType::Bit, "Bit"),
    (ArrayType::String, "String"),
];

impl ArrayType {
    /// The name in a file, such as `Float64`.
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(kind, _)| *kind == self).map_or("", |(_, name)| name)
    }

    /// The type of that name; `None` for a name VTK does not have.
    pub fn from_name(name: &str) -> Option<Self> {
        NAMES.iter().find(|(_, known)| *known == name).map(|(kind, _)| *kind)
    }

    /// Whether the values are `Float32` or `Float64`.
    pub fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }
}

impl fmt::Display for ArrayType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_to_their_type() {
        for (kind, name) in NAMES {
            assert_eq!(kind.name(), name);
            assert_eq!(ArrayType::from_name(name), Some(kind));
        }
        assert_eq!(ArrayType::from_name("vtkIdType"), None);
    }
}
