//! How to write a file.

use std::str::FromStr;

use super::array_type::ArrayType;

/// How the values of arrays are written down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Bytes as they are, appended: the fastest.
    #[default]
    Raw,
    /// Compressed with zlib, appended.
    Zlib,
    /// Compressed with LZ4, appended: faster than zlib, larger files.
    Lz4,
    /// Compressed with LZMA, appended: slower than zlib, smaller files.
    Lzma,
    /// Base64 inside the XML: for tools that want plain XML.
    Base64,
    /// Numbers as text, each exactly as it is: for people.
    Ascii,
}

impl FromStr for Encoding {
    type Err = String;

    /// The encoding of a name in small letters, such as `raw`.
    fn from_str(name: &str) -> Result<Self, String> {
        match name {
            "raw" => Ok(Self::Raw),
            "zlib" => Ok(Self::Zlib),
            "lz4" => Ok(Self::Lz4),
            "lzma" => Ok(Self::Lzma),
            "base64" => Ok(Self::Base64),
            "ascii" => Ok(Self::Ascii),
            _ => Err(format!("unknown encoding '{name}'")),
        }
    }
}

/// The precision of the floats in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Floats {
    /// As they are given.
    #[default]
    AsGiven,
    /// `Float64` arrays become `Float32`.
    Single,
    /// `Float32` arrays become `Float64`.
    Double,
}

impl Floats {
    /// The type in a file of an array of that type.
    pub(super) fn applied_to(self, kind: ArrayType) -> ArrayType {
        match (self, kind) {
            (Self::Single, ArrayType::F64) => ArrayType::F32,
            (Self::Double, ArrayType::F32) => ArrayType::F64,
            _ => kind,
        }
    }
}

/// How to write a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// How values are written down.
    pub encoding: Encoding,
    /// The precision of floats, those of points included.
    pub floats: Floats,
}

impl From<Encoding> for WriteOptions {
    fn from(encoding: Encoding) -> Self {
        Self { encoding, floats: Floats::default() }
    }
}
