//! Random changes to the bytes of a file, some blind, some with the format in mind.

/// Xorshift: the same mutations in every run.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.max(1).wrapping_mul(0x9E37_79B9_7F4A_7C15))
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number below `bound`.
    pub fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound.max(1) as u64) as usize
    }

    fn pick<'a, T: ?Sized>(&mut self, items: &[&'a T]) -> &'a T {
        items[self.below(items.len())]
    }
}

const NUMBERS: [&str; 10] = [
    "0",
    "-1",
    "1",
    "7",
    "4294967295",
    "4294967296",
    "1000000000000000",
    "9223372036854775807",
    "18446744073709551615",
    "99999999999999999999999",
];

const WORDS: [&str; 36] = [
    "Int8",
    "UInt64",
    "Float32",
    "Float64",
    "String",
    "Bit",
    "ascii",
    "binary",
    "appended",
    "raw",
    "base64",
    "UInt32",
    "LittleEndian",
    "BigEndian",
    "vtkZLibDataCompressor",
    "vtkLZ4DataCompressor",
    "vtkLZMADataCompressor",
    "connectivity",
    "offsets",
    "types",
    "faces",
    "Points",
    "SCALARS",
    "VECTORS",
    "FIELD",
    "METADATA",
    "COMPONENT_NAMES",
    "OFFSETS",
    "CONNECTIVITY",
    "POINT_DATA",
    "CELL_DATA",
    "vtktypeint64",
    "float",
    "double",
    "string",
    "5.1",
];

/// Changes one thing somewhere.
pub fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    if bytes.is_empty() {
        return;
    }
    let at = random.below(bytes.len());
    match random.below(8) {
        0 => bytes[at] ^= 1 << random.below(8),
        1 => bytes[at] = random.next() as u8,
        2 => bytes.insert(at, random.next() as u8),
        3 => drop(bytes.drain(at..(at + 1 + random.below(9)).min(bytes.len()))),
        4 => replace_number(bytes, at, random.pick(&NUMBERS)),
        5 => replace_word(bytes, at, random),
        6 => overwrite(bytes, at, random),
        _ => repeat(bytes, at, random),
    }
}

/// Replaces the next digits by another number.
fn replace_number(bytes: &mut Vec<u8>, at: usize, number: &str) {
    let is_digit = u8::is_ascii_digit;
    let Some(start) = bytes[at..].iter().position(is_digit).map(|p| at + p) else {
        return;
    };
    let digits = bytes[start..].iter().take_while(|byte| is_digit(byte)).count();
    bytes.splice(start..start + digits, number.bytes());
}

/// Replaces the next word between quotes that is one of the format's by another.
fn replace_word(bytes: &mut Vec<u8>, at: usize, random: &mut Random) {
    let found = (at..bytes.len()).find_map(|start| {
        let rest = &bytes[start..];
        let word = WORDS.iter().find(|word| rest.starts_with(word.as_bytes()))?;
        Some(start..start + word.len())
    });
    if let Some(range) = found {
        bytes.splice(range, random.pick(&WORDS).bytes());
    }
}

/// Overwrites a word of a header or of data by an extreme one.
fn overwrite(bytes: &mut [u8], at: usize, random: &mut Random) {
    let value = [0, 1, u64::MAX, 1 << 60, i64::MAX as u64, u64::from(u32::MAX)][random.below(6)];
    let value = match random.below(2) {
        0 => value.to_le_bytes(),
        _ => value.to_be_bytes(),
    };
    let width = [4, 8][random.below(2)];
    for (byte, new) in bytes[at..].iter_mut().zip(&value[..width]) {
        *byte = *new;
    }
}

fn repeat(bytes: &mut Vec<u8>, at: usize, random: &mut Random) {
    let end = (at + random.below(200)).min(bytes.len());
    let part = bytes[at..end].to_vec();
    let place = random.below(bytes.len());
    bytes.splice(place..place, part);
}
