//! A small encoder of `.vtu` files, written apart from the library: what the library reads
//! in these files was not written by its own code. It writes every variant of the format.

#![allow(dead_code)] // each test uses its part

use std::fmt::Write as _;
use std::io::Write as _;

/// One of the ways to write a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variant {
    pub format: Format,
    pub compressor: Option<Compressor>,
    pub wide_header: bool,
    pub big_endian: bool,
    /// Bytes of one compressed block.
    pub block: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Format {
    Ascii,
    Inline,
    AppendedBase64,
    AppendedRaw,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Compressor {
    Zlib,
    Lz4,
    Lzma,
}

/// Every combination, with two block sizes.
pub fn variants() -> Vec<Variant> {
    let formats = [Format::Ascii, Format::Inline, Format::AppendedBase64, Format::AppendedRaw];
    let compressors = [None, Some(Compressor::Zlib), Some(Compressor::Lz4), Some(Compressor::Lzma)];
    let mut all = Vec::new();
    for format in formats {
        for compressor in compressors {
            for bits in 0..8 {
                all.push(Variant {
                    format,
                    compressor,
                    wide_header: bits & 1 > 0,
                    big_endian: bits & 2 > 0,
                    block: if bits & 4 > 0 { 48 } else { 1 << 15 },
                });
            }
        }
    }
    all
}

/// Values of one array: text for ascii, and bytes of one value in both orders.
pub struct Column {
    kind: &'static str,
    texts: Vec<String>,
    little: Vec<Vec<u8>>,
}

macro_rules! column {
    ($name:ident, $type:ty, $kind:literal) => {
        pub fn $name(values: &[$type]) -> Column {
            Column {
                kind: $kind,
                texts: values.iter().map(|v| format!("{v:e}")).collect(),
                little: values.iter().map(|v| v.to_le_bytes().to_vec()).collect(),
            }
            .plain_integers()
        }
    };
}

column!(i8s, i8, "Int8");
column!(u8s, u8, "UInt8");
column!(i16s, i16, "Int16");
column!(u16s, u16, "UInt16");
column!(i32s, i32, "Int32");
column!(u32s, u32, "UInt32");
column!(i64s, i64, "Int64");
column!(u64s, u64, "UInt64");
column!(f32s, f32, "Float32");
column!(f64s, f64, "Float64");

impl Column {
    /// Integers are not written with exponents.
    fn plain_integers(mut self) -> Self {
        if !self.kind.starts_with("Float") {
            let number = |bytes: &Vec<u8>| {
                let negative = self.kind.starts_with('I') && bytes.last().unwrap() >= &128;
                let fill = if negative { 255 } else { 0 };
                let mut wide = [fill; 16];
                wide[..bytes.len()].copy_from_slice(bytes);
                i128::from_le_bytes(wide).to_string()
            };
            self.texts = self.little.iter().map(number).collect();
        }
        self
    }

    fn bytes(&self, big_endian: bool) -> Vec<u8> {
        let value = |bytes: &Vec<u8>| {
            let mut bytes = bytes.clone();
            if big_endian {
                bytes.reverse();
            }
            bytes
        };
        self.little.iter().flat_map(value).collect()
    }
}

/// A file under construction.
pub struct Encoder {
    variant: Variant,
    head: String,
    appended: Vec<u8>,
}

impl Encoder {
    pub fn new(kind: &str, variant: Variant) -> Self {
        let order = if variant.big_endian { "Big" } else { "Little" };
        let word = if variant.wide_header { 64 } else { 32 };
        let mut head = format!("<VTKFile type=\"{kind}\" byte_order=\"{order}Endian\"");
        if variant.wide_header || variant.big_endian {
            write!(head, " header_type=\"UInt{word}\"").unwrap();
        }
        match variant.compressor {
            None => {}
            Some(Compressor::Zlib) => head += " compressor=\"vtkZLibDataCompressor\"",
            Some(Compressor::Lz4) => head += " compressor=\"vtkLZ4DataCompressor\"",
            Some(Compressor::Lzma) => head += " compressor=\"vtkLZMADataCompressor\"",
        }
        writeln!(head, "><{kind}>").unwrap();
        Self { variant, head, appended: Vec::new() }
    }

    /// Adds text to the head.
    pub fn raw(&mut self, text: &str) -> &mut Self {
        self.head += text;
        self
    }

    /// Adds an array.
    pub fn array(&mut self, name: &str, components: usize, column: &Column) -> &mut Self {
        let mut tag = format!("<DataArray type=\"{}\" Name=\"{name}\"", column.kind);
        write!(tag, " NumberOfComponents=\"{components}\"").unwrap();
        match self.variant.format {
            Format::Ascii => {
                let text = column.texts.join(" ");
                writeln!(self.head, "{tag} format=\"ascii\">\n{text}\n</DataArray>").unwrap();
            }
            Format::Inline => {
                let text = String::from_utf8(self.encode(column, true)).unwrap();
                writeln!(self.head, "{tag} format=\"binary\">\n {text}\n</DataArray>").unwrap();
            }
            Format::AppendedBase64 | Format::AppendedRaw => {
                let base64 = self.variant.format == Format::AppendedBase64;
                let offset = self.appended.len();
                let data = self.encode(column, base64);
                self.appended.extend(data);
                writeln!(self.head, "{tag} format=\"appended\" offset=\"{offset}\"/>").unwrap();
            }
        }
        self
    }

    pub fn finish(self, kind: &str) -> Vec<u8> {
        let mut file = self.head.into_bytes();
        write!(file, "</{kind}>").unwrap();
        let encoding = match self.variant.format {
            Format::AppendedBase64 => "base64",
            Format::AppendedRaw => "raw",
            Format::Ascii | Format::Inline => "",
        };
        if !encoding.is_empty() {
            write!(file, "<AppendedData encoding=\"{encoding}\">_").unwrap();
            file.extend(self.appended);
            write!(file, "</AppendedData>").unwrap();
        }
        write!(file, "</VTKFile>").unwrap();
        file
    }

    fn encode(&self, column: &Column, as_base64: bool) -> Vec<u8> {
        let bytes = column.bytes(self.variant.big_endian);
        let runs = match self.variant.compressor {
            None => vec![[self.word(bytes.len()), bytes].concat()],
            Some(compressor) => self.compressed(&bytes, compressor),
        };
        match as_base64 {
            true => runs.iter().flat_map(|run| base64(run)).collect(),
            false => runs.concat(),
        }
    }

    fn compressed(&self, bytes: &[u8], compressor: Compressor) -> Vec<Vec<u8>> {
        let chunks = bytes.chunks(self.variant.block);
        let blocks: Vec<_> = chunks.map(|chunk| compress(chunk, compressor)).collect();
        let last = bytes.len() % self.variant.block;
        let mut header = [blocks.len(), self.variant.block, last].map(|n| self.word(n)).concat();
        header.extend(blocks.iter().flat_map(|block| self.word(block.len())));
        vec![header, blocks.concat()]
    }

    fn word(&self, number: usize) -> Vec<u8> {
        let mut word = (number as u64).to_le_bytes().to_vec();
        word.truncate(if self.variant.wide_header { 8 } else { 4 });
        if self.variant.big_endian {
            word.reverse();
        }
        word
    }
}

fn compress(bytes: &[u8], compressor: Compressor) -> Vec<u8> {
    match compressor {
        Compressor::Zlib => {
            let level = flate2::Compression::default();
            let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), level);
            encoder.write_all(bytes).unwrap();
            encoder.finish().unwrap()
        }
        Compressor::Lz4 => lz4_flex::block::compress(bytes),
        Compressor::Lzma => {
            let options = lzma_rust2::XzOptions::with_preset(0);
            let mut encoder = lzma_rust2::XzWriter::new(Vec::new(), options).unwrap();
            encoder.write_all(bytes).unwrap();
            encoder.finish().unwrap()
        }
    }
}

fn base64(bytes: &[u8]) -> Vec<u8> {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |chunk: &[u8]| {
        let byte = |index: usize| u32::from(*chunk.get(index).unwrap_or(&0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        let digit = |index: usize| match index <= chunk.len() {
            true => DIGITS[(bits >> (18 - 6 * index)) as usize & 63],
            false => b'=',
        };
        [0, 1, 2, 3].map(digit)
    };
    bytes.chunks(3).flat_map(group).collect()
}

/// A tetrahedron and two triangles with one array of every type.
pub fn sample(variant: Variant) -> Vec<u8> {
    let mut file = Encoder::new("UnstructuredGrid", variant);
    file.raw("<FieldData>")
        .array("TimeValue", 1, &f64s(&[0.25]))
        .raw("</FieldData><Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">")
        .raw("<PointData Scalars=\"a &lt;f64&gt;\">")
        .array("a &lt;f64&gt;", 1, &f64s(&[0.1, -2e-300, 3e300, 0.0, 5.0]))
        .array("f32", 3, &f32s(&(0..15).map(|i| i as f32 / 7.0).collect::<Vec<_>>()))
        .array("i8", 1, &i8s(&[-128, -1, 0, 1, 127]))
        .array("u8", 1, &u8s(&[0, 1, 2, 254, 255]))
        .array("i16", 2, &i16s(&[-32768, -2, -1, 0, 1, 2, 3, 4, 5, 32767]))
        .array("u16", 1, &u16s(&[0, 1, 2, 3, 65535]))
        .raw("</PointData><CellData>")
        .array("i32", 1, &i32s(&[i32::MIN, 0, i32::MAX]))
        .array("u32", 1, &u32s(&[0, 1, u32::MAX]))
        .array("i64", 1, &i64s(&[i64::MIN, 0, i64::MAX]))
        .array("u64", 1, &u64s(&[0, 1, u64::MAX]))
        .raw("</CellData><Points>");
    let points: Vec<f64> = (0..15).map(|i| f64::from(i * i % 7)).collect();
    file.array("Points", 3, &f64s(&points))
        .raw("</Points><Cells>")
        .array("connectivity", 1, &i32s(&[0, 1, 2, 3, 0, 1, 2, 2, 3, 4]))
        .array("offsets", 1, &i64s(&[4, 7, 10]))
        .array("types", 1, &u8s(&[10, 5, 5]))
        .raw("</Cells></Piece>");
    file.finish("UnstructuredGrid")
}
