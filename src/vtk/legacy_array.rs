//! One array of a legacy file: found first, decoded when it is asked for.

use super::array_type::ArrayType;
use super::data_array::DataArray;
use super::encoding::ByteOrder;
use super::error::{ArrayError, LegacyProblem};
use super::legacy_scanner::{LegacyFlaw, Scanner, decode};
use super::payload::Payload;
use super::scalar::Scalar;
use super::values::{Values, match_type};
use std::ops::Range;

/// How a legacy file writes values down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LegacyCoding {
    Ascii,
    /// Big-endian.
    Binary,
}

/// The type of values as they are in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stored {
    As(ArrayType),
    /// VTK's indices, written in 32 bits but kept in 64.
    Index,
    /// Colours: bytes in binary files, numbers from 0 to 1 in ascii.
    Colour,
}

/// One array of a legacy file, of which only the place is known.
#[derive(Clone, Debug)]
pub(super) struct LegacyArray {
    pub(super) name: String,
    pub(super) components: usize,
    pub(super) component_names: Vec<String>,
    pub(super) tuples: usize,
    stored: Stored,
    coding: LegacyCoding,
    place: Range<usize>,
}

impl LegacyArray {
    /// Finds the values of that type which follow, and the names of their components.
    pub(super) fn scan(
        scanner: &mut Scanner<'_>,
        coding: LegacyCoding,
        name: &str,
        kind: &[u8],
        (tuples, components): (usize, usize),
    ) -> Result<Self, LegacyFlaw> {
        let stored = stored(kind).ok_or_else(|| {
            let problem = ArrayError::UnknownType(String::from_utf8_lossy(kind).into_owned());
            scanner.flaw(LegacyProblem::Array { name: name.to_owned(), problem })
        })?;
        let mut array = Self {
            name: name.to_owned(),
            components: components.max(1),
            component_names: Vec::new(),
            tuples,
            stored,
            coding,
            place: 0..0,
        };
        array.place = match tuples.checked_mul(array.components) {
            Some(0) => 0..0,
            count => array.skip(scanner, count.unwrap_or(usize::MAX))?,
        };
        array.scan_metadata(scanner)?;
        Ok(array)
    }

    /// The type of the values in memory.
    pub(super) fn array_type(&self) -> ArrayType {
        match self.stored {
            Stored::As(kind) => kind,
            Stored::Index => ArrayType::I64,
            Stored::Colour => ArrayType::U8,
        }
    }

    /// Passes over `count` values.
    fn skip(&self, scanner: &mut Scanner<'_>, count: usize) -> Result<Range<usize>, LegacyFlaw> {
        let is_text = self.stored == Stored::As(ArrayType::String);
        let size = match (self.coding, self.stored) {
            (LegacyCoding::Ascii, _) if !is_text => return scanner.words(count),
            (_, Stored::As(ArrayType::String)) => {
                scanner.end_line()?;
                return skip_strings(scanner, self.coding, count);
            }
            (_, Stored::As(kind)) => match_type!(kind, T => size_of::<T>(), other => 0),
            (_, Stored::Index) => 4,
            (_, Stored::Colour) => 1,
        };
        scanner.end_line()?;
        let bytes = match size {
            0 => Some(count.div_ceil(8)),
            size => count.checked_mul(size),
        };
        scanner.block(bytes.unwrap_or(usize::MAX))
    }

    /// Reads what VTK writes behind an array: the names of its components, and ranges of
    /// its values, which are passed over. A blank line ends it.
    fn scan_metadata(&mut self, scanner: &mut Scanner<'_>) -> Result<(), LegacyFlaw> {
        if !scanner.next_is("metadata") {
            return Ok(());
        }
        scanner.end_line()?;
        let mut keys = 0usize;
        loop {
            let cut = scanner.flaw(LegacyProblem::Ends { expected: "the end of METADATA" });
            let Some(line) = scanner.line() else {
                return Err(cut);
            };
            let word = line.split(u8::is_ascii_whitespace).next().unwrap_or_default();
            if word.eq_ignore_ascii_case(b"component_names") {
                let lines = (0..self.components).map_while(|_| scanner.line());
                self.component_names = lines.map(decode).collect();
                if self.component_names.len() < self.components {
                    return Err(cut);
                }
            } else if word.eq_ignore_ascii_case(b"information") {
                let number = line.get(word.len()..).unwrap_or_default().trim_ascii();
                keys = Scanner::new(number).count("a count").unwrap_or(0);
            } else if word == b"NAME" {
                keys = keys.saturating_sub(1);
            } else if line.is_empty() && keys == 0 {
                break;
            }
        }
        let named = |name: &String| !name.is_empty();
        let count = self.component_names.iter().rposition(named).map_or(0, |last| last + 1);
        self.component_names.truncate(count);
        Ok(())
    }

    /// Decodes the values.
    pub(super) fn decode(&self, bytes: &[u8]) -> Result<DataArray, ArrayError> {
        let payload = self.payload(bytes);
        let values = match self.stored {
            Stored::Index if self.coding == LegacyCoding::Binary => {
                let short = payload.to_vec::<i32>()?;
                Values::I64(short.into_iter().map(i64::from).collect())
            }
            Stored::Colour if self.coding == LegacyCoding::Ascii => {
                let shares = payload.to_vec::<f32>()?;
                Values::U8(shares.into_iter().map(|share| (255.0 * share + 0.5) as u8).collect())
            }
            _ => {
                match_type!(self.array_type(), T => T::into_values(payload.to_vec::<T>()?), other => {
                    self.decode_special(bytes, &payload)?
                })
            }
        };
        Ok(DataArray {
            name: self.name.clone(),
            components: self.components,
            component_names: self.component_names.clone(),
            values,
        })
    }

    /// Decodes integers of any type one after the other, without a vector of them all.
    pub(super) fn for_each_index(
        &self,
        bytes: &[u8],
        mut take: impl FnMut(i64) -> Result<(), ArrayError>,
    ) -> Result<(), ArrayError> {
        let text = bytes.get(self.place.clone()).unwrap_or_default();
        match (self.coding, self.stored) {
            (LegacyCoding::Ascii, _) => {
                let mut scanner = Scanner::new(text);
                while let Some(word) = scanner.next_word() {
                    let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
                    take(number.ok_or_else(|| no_index(word))?)?;
                }
                Ok(())
            }
            (LegacyCoding::Binary, Stored::Index | Stored::As(ArrayType::I32)) => {
                let word =
                    |word: &[u8]| word.iter().fold(0i32, |n, byte| n << 8 | i32::from(*byte));
                text.chunks_exact(4).try_for_each(|bytes| take(i64::from(word(bytes))))
            }
            (LegacyCoding::Binary, Stored::As(ArrayType::I64)) => {
                let word =
                    |word: &[u8]| word.iter().fold(0i64, |n, byte| n << 8 | i64::from(*byte));
                text.chunks_exact(8).try_for_each(|bytes| take(word(bytes)))
            }
            _ => {
                Err(ArrayError::WrongType { found: self.array_type(), expected: "Int32 or Int64" })
            }
        }
    }

    fn payload<'a>(&self, bytes: &'a [u8]) -> Payload<'a> {
        let coded = bytes.get(self.place.clone()).unwrap_or_default();
        match self.coding {
            LegacyCoding::Ascii => Payload::ascii(coded, self.place.start),
            LegacyCoding::Binary => Payload::raw(coded, self.place.start, ByteOrder::Big),
        }
    }

    /// Bits and strings.
    fn decode_special(&self, bytes: &[u8], payload: &Payload<'_>) -> Result<Values, ArrayError> {
        let count = self.tuples.saturating_mul(self.components);
        if self.array_type() == ArrayType::String {
            return Ok(Values::Strings(self.strings(bytes, count)));
        }
        let packed = payload.to_vec::<u8>()?;
        if self.coding == LegacyCoding::Ascii {
            return Ok(Values::U8(packed));
        }
        let bit = |index: usize| packed.get(index / 8).map(|byte| byte >> (7 - index % 8) & 1);
        Ok(Values::U8((0..count).map_while(bit).collect()))
    }

    fn strings(&self, bytes: &[u8], count: usize) -> Vec<String> {
        let coded = bytes.get(self.place.clone()).unwrap_or_default();
        let mut scanner = Scanner::new(coded);
        let mut next = || match self.coding {
            LegacyCoding::Ascii => scanner.line().map(decode),
            LegacyCoding::Binary => {
                let text = scanner.string().ok().and_then(|place| coded.get(place));
                text.map(|text| String::from_utf8_lossy(text).into_owned())
            }
        };
        (0..count).map_while(|_| next()).collect()
    }
}

fn no_index(word: &[u8]) -> ArrayError {
    let shown = word.get(..word.len().min(40)).unwrap_or_default();
    ArrayError::NoIndex { value: String::from_utf8_lossy(shown).into_owned() }
}

fn skip_strings(
    scanner: &mut Scanner<'_>,
    coding: LegacyCoding,
    count: usize,
) -> Result<Range<usize>, LegacyFlaw> {
    let start = scanner.position();
    for _ in 0..count {
        match coding {
            LegacyCoding::Binary => {
                scanner.string()?;
            }
            LegacyCoding::Ascii if scanner.line().is_some() => {}
            LegacyCoding::Ascii => {
                return Err(scanner.flaw(LegacyProblem::Ends { expected: "a string" }));
            }
        }
    }
    Ok(start..scanner.position())
}

/// What a legacy file calls a type.
fn stored(name: &[u8]) -> Option<Stored> {
    const NAMES: [(&str, Stored); 20] = [
        ("bit", Stored::As(ArrayType::Bit)),
        ("char", Stored::As(ArrayType::I8)),
        ("signed_char", Stored::As(ArrayType::I8)),
        ("unsigned_char", Stored::As(ArrayType::U8)),
        ("short", Stored::As(ArrayType::I16)),
        ("unsigned_short", Stored::As(ArrayType::U16)),
        ("int", Stored::As(ArrayType::I32)),
        ("unsigned_int", Stored::As(ArrayType::U32)),
        // As on every system but Windows.
        ("long", Stored::As(ArrayType::I64)),
        ("unsigned_long", Stored::As(ArrayType::U64)),
        ("vtktypeint64", Stored::As(ArrayType::I64)),
        ("vtktypeuint64", Stored::As(ArrayType::U64)),
        ("long_long", Stored::As(ArrayType::I64)),
        ("unsigned_long_long", Stored::As(ArrayType::U64)),
        ("float", Stored::As(ArrayType::F32)),
        ("double", Stored::As(ArrayType::F64)),
        ("string", Stored::As(ArrayType::String)),
        ("utf8_string", Stored::As(ArrayType::String)),
        ("vtkidtype", Stored::Index),
        (COLOUR, Stored::Colour),
    ];
    let found = NAMES.iter().find(|(known, _)| name.eq_ignore_ascii_case(known.as_bytes()));
    found.map(|(_, stored)| *stored)
}

/// A name no file has, for the type of colours, which files do not name.
pub(super) const COLOUR: &str = "a colour";
