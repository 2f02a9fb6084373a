//! Writing VTK's XML: elements, arrays in any encoding, appended data.

use super::array_type::ArrayType;
use super::base64::Encoder;
use super::column::Column;
use super::compression::Compressor;
use super::write_options::{Encoding, WriteOptions};
use quick_xml::escape::escape;
use rayon::prelude::*;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Values that are converted, or printed by one thread, at a time.
const CHUNK: usize = 1 << 14;

/// What the element of an array says besides its type and place.
pub(super) struct ArrayTag<'a> {
    pub(super) name: &'a str,
    pub(super) components: usize,
    pub(super) component_names: &'a [String],
    /// The number of tuples, where nothing else tells it (field data).
    pub(super) tuples: Option<usize>,
}

impl<'a> ArrayTag<'a> {
    /// An array of single values.
    pub(super) fn plain(name: &'a str) -> Self {
        Self { name, components: 1, component_names: &[], tuples: None }
    }
}

/// Values kept for the appended data.
enum Stored<'a> {
    Plain(Box<dyn Column + 'a>),
    Compressed { header: Vec<u8>, blocks: Vec<Vec<u8>> },
}

/// Writes one VTK XML file.
pub(super) struct XmlWriter<'a, W: Write> {
    out: W,
    encoding: Encoding,
    depth: usize,
    stored: Vec<Stored<'a>>,
    /// Where the next stored values will begin in the appended data.
    offset: u64,
}

impl<'a, W: Write> XmlWriter<'a, W> {
    /// Begins a file of that type of data set.
    pub(super) fn begin(out: W, kind: &str, options: WriteOptions) -> io::Result<Self> {
        Self::begin_version(out, kind, "1.0", options)
    }

    /// Begins a file of that type of data set in that version of the format.
    pub(super) fn begin_version(
        mut out: W,
        kind: &str,
        version: &str,
        options: WriteOptions,
    ) -> io::Result<Self> {
        let mut head = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"{version}\" \
             byte_order=\"LittleEndian\" header_type=\"UInt64\""
        );
        if let Some(compressor) = compressor(options.encoding) {
            let _ = write!(head, " compressor=\"{}\"", compressor.name());
        }
        writeln!(out, "{head}>")?;
        Ok(Self { out, encoding: options.encoding, depth: 1, stored: Vec::new(), offset: 0 })
    }

    /// Writes a start tag.
    pub(super) fn open(&mut self, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
        let mut tag = format!("<{name}");
        for (key, value) in attributes {
            push_attribute(&mut tag, key, value);
        }
        self.line(&format!("{tag}>"))?;
        self.depth += 1;
        Ok(())
    }

    /// Writes an element with nothing inside.
    pub(super) fn empty(&mut self, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
        let mut tag = format!("<{name}");
        for (key, value) in attributes {
            push_attribute(&mut tag, key, value);
        }
        self.line(&format!("{tag}/>"))
    }

    /// Writes the element that declares an array of the pieces.
    pub(super) fn declare(&mut self, kind: ArrayType, tag: &ArrayTag<'_>) -> io::Result<()> {
        let (_, head) = start_tag("P", tag, kind);
        self.line(&format!("{head}/>"))
    }

    /// Writes an end tag.
    pub(super) fn close(&mut self, name: &str) -> io::Result<()> {
        self.depth = self.depth.saturating_sub(1);
        self.line(&format!("</{name}>"))
    }

    fn line(&mut self, text: &str) -> io::Result<()> {
        writeln!(self.out, "{:indent$}{text}", "", indent = 2 * self.depth)
    }

    /// Writes an array, or keeps it for the appended data.
    pub(super) fn array(
        &mut self,
        tag: &ArrayTag<'_>,
        column: Box<dyn Column + 'a>,
    ) -> io::Result<()> {
        let (element, head) = start_tag("", tag, column.array_type());
        match self.encoding {
            Encoding::Ascii => {
                self.line(&format!("{head} format=\"ascii\">"))?;
                write_ascii(&mut self.out, &*column, tag.components)?;
            }
            Encoding::Base64 => {
                self.line(&format!("{head} format=\"binary\">"))?;
                write_base64(&mut self.out, &*column)?;
            }
            Encoding::Raw | Encoding::Zlib | Encoding::Lz4 | Encoding::Lzma => {
                let offset = self.store(column)?;
                return self.line(&format!("{head} format=\"appended\" offset=\"{offset}\"/>"));
            }
        }
        self.line(&format!("</{element}>"))
    }

    /// Keeps values for the appended data; returns where they will begin.
    fn store(&mut self, column: Box<dyn Column + 'a>) -> io::Result<u64> {
        let offset = self.offset;
        let stored = match compressor(self.encoding) {
            None => Stored::Plain(column),
            Some(compressor) => compress(&*column, compressor)?,
        };
        self.offset += stored.len();
        self.stored.push(stored);
        Ok(offset)
    }

    /// Writes the appended data and ends the file.
    pub(super) fn finish(mut self) -> io::Result<W> {
        if !self.stored.is_empty() {
            self.out.write_all(b"  <AppendedData encoding=\"raw\">\n    _")?;
            for stored in &self.stored {
                stored.write(&mut self.out)?;
            }
            self.out.write_all(b"\n  </AppendedData>\n")?;
        }
        self.out.write_all(b"</VTKFile>\n")?;
        Ok(self.out)
    }
}

impl Stored<'_> {
    /// Bytes in the appended data.
    fn len(&self) -> u64 {
        match self {
            Self::Plain(column) => 8 + byte_count(&**column),
            Self::Compressed { header, blocks } => {
                let blocks: usize = blocks.iter().map(Vec::len).sum();
                (header.len() + blocks) as u64
            }
        }
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self {
            Self::Plain(column) => {
                out.write_all(&byte_count(&**column).to_le_bytes())?;
                write_bytes(out, &**column)
            }
            Self::Compressed { header, blocks } => {
                out.write_all(header)?;
                blocks.iter().try_for_each(|block| out.write_all(block))
            }
        }
    }
}

fn compressor(encoding: Encoding) -> Option<Compressor> {
    match encoding {
        Encoding::Zlib => Some(Compressor::Zlib),
        Encoding::Lz4 => Some(Compressor::Lz4),
        Encoding::Lzma => Some(Compressor::Lzma),
        Encoding::Raw | Encoding::Base64 | Encoding::Ascii => None,
    }
}

fn byte_count(column: &dyn Column) -> u64 {
    (column.len() * column.value_size()) as u64
}

/// The element's name, and its start tag as far as the format.
fn start_tag(prefix: &str, tag: &ArrayTag<'_>, kind: ArrayType) -> (&'static str, String) {
    let element = match kind {
        ArrayType::String => "Array",
        _ => "DataArray",
    };
    let mut head = format!("<{prefix}{element} type=\"{kind}\"");
    push_attribute(&mut head, "Name", tag.name);
    if tag.components != 1 {
        push_attribute(&mut head, "NumberOfComponents", &tag.components.to_string());
    }
    for (index, name) in tag.component_names.iter().enumerate() {
        if !name.is_empty() && index < tag.components {
            push_attribute(&mut head, &format!("ComponentName{index}"), name);
        }
    }
    if let Some(tuples) = tag.tuples {
        push_attribute(&mut head, "NumberOfTuples", &tuples.to_string());
    }
    (element, head)
}

/// Appends ` key="value"`, escaped so that every XML reader gives the value back. Control
/// characters, which XML cannot hold in any form, become U+FFFD.
fn push_attribute(tag: &mut String, key: &str, value: &str) {
    let _ = write!(tag, " {key}=\"");
    for part in value.split_inclusive(char::is_control) {
        let text = part.trim_end_matches(char::is_control);
        tag.push_str(&escape(text));
        match part[text.len()..].chars().next() {
            None => {}
            Some(blank @ ('\t' | '\n' | '\r' | '\u{7F}'..='\u{9F}')) => {
                let _ = write!(tag, "&#{};", u32::from(blank));
            }
            Some(_) => tag.push('\u{FFFD}'),
        }
    }
    tag.push('"');
}

/// Ranges of `step` values that cover a column.
fn ranges(len: usize, step: usize) -> impl IndexedParallelIterator<Item = std::ops::Range<usize>> {
    let range = move |index: usize| index * step..len.min((index + 1) * step);
    (0..len.div_ceil(step)).into_par_iter().map(range)
}

/// Compresses all blocks, on all threads.
fn compress<'a>(column: &dyn Column, compressor: Compressor) -> io::Result<Stored<'a>> {
    let block = |range| compressor.compress(&column.bytes(range));
    let size = compressor.block_size();
    let blocks = ranges(column.len(), size / column.value_size()).map(block);
    let blocks = blocks.collect::<io::Result<Vec<Vec<u8>>>>()?;
    // A last size of 0 stands for a full block.
    let last = byte_count(column) % size as u64;
    let sizes = blocks.iter().map(|block| block.len() as u64);
    let words = [blocks.len() as u64, size as u64, last].into_iter().chain(sizes);
    Ok(Stored::Compressed { header: words.flat_map(u64::to_le_bytes).collect(), blocks })
}

fn write_bytes(out: &mut impl Write, column: &dyn Column) -> io::Result<()> {
    let mut start = 0;
    while start < column.len() {
        let end = column.len().min(start + CHUNK);
        out.write_all(&column.bytes(start..end))?;
        start = end;
    }
    Ok(())
}

/// Header and values as one base64 run.
fn write_base64(out: &mut impl Write, column: &dyn Column) -> io::Result<()> {
    let mut encoder = Encoder::new(&mut *out);
    encoder.write_all(&byte_count(column).to_le_bytes())?;
    write_bytes(&mut encoder, column)?;
    encoder.finish()?;
    out.write_all(b"\n")
}

/// Tuples of several components take a line each, single values ten to a line.
fn write_ascii(out: &mut impl Write, column: &dyn Column, components: usize) -> io::Result<()> {
    let line = if components > 1 { components } else { 10 };
    let chunk = CHUNK.div_ceil(line) * line;
    // A few chunks a thread at a time: the text is never in memory as a whole.
    let wave = chunk * 4 * rayon::current_num_threads();
    let mut start = 0;
    while start < column.len() {
        let end = column.len().min(start + wave);
        let print = |part: std::ops::Range<usize>| {
            print_lines(column, start + part.start..start + part.end, line)
        };
        let texts: Vec<Vec<u8>> = ranges(end - start, chunk).map(print).collect();
        texts.iter().try_for_each(|text| out.write_all(text))?;
        start = end;
    }
    Ok(())
}

fn print_lines(column: &dyn Column, range: std::ops::Range<usize>, line: usize) -> Vec<u8> {
    let mut text = Vec::with_capacity(range.len() * 12);
    let mut start = range.start;
    while start < range.end {
        let end = range.end.min(start + line);
        column.text(start..end, &mut text);
        text.push(b'\n');
        start = end;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::column::numbers;

    fn attribute(value: &str) -> String {
        let mut tag = String::new();
        push_attribute(&mut tag, "k", value);
        tag
    }

    #[test]
    fn attributes_are_escaped() {
        assert_eq!(attribute("a<\"&'>b"), " k=\"a&lt;&quot;&amp;&apos;&gt;b\"");
        assert_eq!(attribute("a\tb\n"), " k=\"a&#9;b&#10;\"");
        assert_eq!(attribute("\u{1}é\u{85}"), " k=\"\u{FFFD}é&#133;\"");
        assert_eq!(attribute(""), " k=\"\"");
    }

    fn file(encoding: Encoding, values: &[u16]) -> String {
        let mut writer = XmlWriter::begin(Vec::new(), "T", encoding.into()).unwrap();
        let column = Box::new(numbers(values));
        writer.array(&ArrayTag::plain("a"), column).unwrap();
        String::from_utf8_lossy(&writer.finish().unwrap()).into_owned()
    }

    #[test]
    fn one_array_in_three_encodings() {
        let ascii = file(Encoding::Ascii, &[1, 2]);
        assert!(ascii.contains("format=\"ascii\">\n 1 2\n  </DataArray>\n</VTKFile>"), "{ascii}");
        let base64 = file(Encoding::Base64, &[1, 2]);
        assert!(base64.contains("\nBAAAAAAAAAABAAIA\n"), "{base64}");
        let raw = file(Encoding::Raw, &[1, 2]);
        assert!(raw.contains("_\u{4}\0\0\0\0\0\0\0\u{1}\0\u{2}\0\n"), "{raw}");
    }

    #[test]
    fn the_last_block_is_partial_full_or_missing() {
        let header = |bytes: usize| {
            let values = vec![0u8; bytes];
            match compress(&numbers(&values[..]), Compressor::Lz4).unwrap() {
                Stored::Compressed { header, blocks } => (header[16..24].to_vec(), blocks.len()),
                Stored::Plain(_) => unreachable!(),
            }
        };
        let block = Compressor::Lz4.block_size();
        let last = |size: u64| size.to_le_bytes().to_vec();
        assert_eq!(header(0), (last(0), 0));
        assert_eq!(header(block), (last(0), 1));
        assert_eq!(header(block + 5), (last(5), 2));
    }
}
