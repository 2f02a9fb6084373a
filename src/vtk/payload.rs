//! The encoded values of one array in one piece: sizes first, then the values.

use super::ascii::AsciiText;
use super::block_table::BlockTable;
use super::compression::Compressor;
use super::encoding::{ByteOrder, Coded, Coding, HeaderWord};
use super::error::ArrayError;
use super::scalar::Scalar;
use crate::large_pages;
use rayon::prelude::*;
use std::ops::Range;

/// How a file writes its binary arrays.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layout {
    pub(super) order: ByteOrder,
    pub(super) word: HeaderWord,
    /// The name of the compressor. A file may declare one VTK does not know and yet
    /// hold only ascii arrays, so it is looked up when it is needed.
    pub(super) compressor: Option<String>,
}

/// The encoded values of one array in one piece. Its header has been read and checked
/// against the size of the file; nothing has been decoded.
#[derive(Debug)]
pub(super) struct Payload<'a> {
    order: ByteOrder,
    form: Form<'a>,
}

#[derive(Debug)]
enum Form<'a> {
    Empty,
    Ascii(AsciiText<'a>),
    /// `bytes` values' bytes after `skip` header bytes in one run.
    Plain {
        coded: Coded<'a>,
        skip: usize,
        bytes: usize,
    },
    Blocks {
        coded: Coded<'a>,
        table: BlockTable,
        compressor: Compressor,
    },
}

impl<'a> Payload<'a> {
    /// No values.
    pub(super) fn empty() -> Self {
        Self { order: ByteOrder::Little, form: Form::Empty }
    }

    /// Numbers as text that begins at byte `offset` of the file.
    pub(super) fn ascii(text: &'a [u8], offset: usize) -> Self {
        Self { form: Form::Ascii(AsciiText::new(text, offset)), ..Self::empty() }
    }

    /// The bytes of values as they are.
    pub(super) fn raw(bytes: &'a [u8], offset: usize, order: ByteOrder) -> Self {
        let coded = Coded { bytes, offset, coding: Coding::Raw };
        Self { order, form: Form::Plain { coded, skip: 0, bytes: bytes.len() } }
    }

    /// Coded bytes that begin with a header.
    ///
    /// # Errors
    /// The header is cut, or promises more than the file can hold.
    pub(super) fn binary(coded: Coded<'a>, layout: &Layout) -> Result<Self, ArrayError> {
        let form = match &layout.compressor {
            None => Self::plain(coded, layout)?,
            Some(name) => {
                let compressor = Compressor::from_name(name)?;
                let (table, coded) =
                    BlockTable::read(coded, layout.word, layout.order, compressor)?;
                Form::Blocks { coded, table, compressor }
            }
        };
        Ok(Self { order: layout.order, form })
    }

    fn plain(coded: Coded<'a>, layout: &Layout) -> Result<Form<'a>, ArrayError> {
        let size = layout.word.size();
        let header = coded.peek(size)?;
        let promised = layout.word.words(&header, layout.order).next().unwrap_or(0);
        let too_large =
            || ArrayError::TooLarge { offset: coded.offset, promised: format!("{promised} bytes") };
        let bytes = usize::try_from(promised).map_err(|_| too_large())?;
        // Some writers code the header as a run of its own; it then ends with padding.
        let own_run = coded.coding == Coding::Base64 && header.len() == size && bytes > 0;
        let (coded, skip) = match own_run {
            true => (coded.after(size)?, 0),
            false => (coded, size),
        };
        let run = bytes.checked_add(skip).ok_or_else(too_large)?;
        coded.check_room(run)?;
        Ok(Form::Plain { coded, skip, bytes })
    }

    /// The bytes of the file that the encoded values take; 0 for ascii, which never
    /// shares them with another array.
    pub(super) fn encoded_len(&self) -> usize {
        match &self.form {
            Form::Empty | Form::Ascii(_) => 0,
            Form::Plain { bytes, .. } => *bytes,
            Form::Blocks { table, .. } => table.compressed(),
        }
    }

    /// How many values of `size` bytes there are.
    ///
    /// # Errors
    /// The bytes are no whole number of values.
    pub(super) fn count(&self, size: usize) -> Result<usize, ArrayError> {
        let bytes = match &self.form {
            Form::Empty => 0,
            Form::Ascii(text) => return Ok(text.count()),
            Form::Plain { bytes, .. } => *bytes,
            Form::Blocks { table, .. } => table.total,
        };
        match bytes.is_multiple_of(size) {
            true => Ok(bytes / size),
            false => Err(ArrayError::PartOfValue { bytes, size }),
        }
    }

    /// The bytes of the values, if they stand in the file as they do in memory, aligned or not.
    pub(super) fn as_it_is(&self) -> Option<&'a [u8]> {
        match &self.form {
            Form::Plain { coded, skip, bytes }
                if coded.coding == Coding::Raw && !self.order.is_foreign() =>
            {
                coded.bytes.get(*skip..*skip + *bytes)
            }
            _ => None,
        }
    }

    /// Whether the values are written as text.
    pub(super) fn is_ascii(&self) -> bool {
        matches!(self.form, Form::Ascii(_))
    }

    /// Decodes into `dest`, whose length must be [`count`](Self::count).
    ///
    /// # Errors
    /// The length differs, or the data are corrupt.
    pub(super) fn decode<T: Scalar>(&self, dest: &mut [T]) -> Result<(), ArrayError> {
        let found = self.count(size_of::<T>())?;
        if found != dest.len() {
            return Err(ArrayError::Count { found, expected: dest.len() });
        }
        match &self.form {
            Form::Empty => return Ok(()),
            Form::Ascii(text) => return text.parse(dest),
            Form::Plain { coded, skip, .. } => {
                coded.decode(*skip, bytemuck::cast_slice_mut(dest))?;
            }
            Form::Blocks { coded, table, compressor } => {
                decode_blocks(*coded, table, *compressor, bytemuck::cast_slice_mut(dest))?
            }
        }
        if self.order.is_foreign() && size_of::<T>() > 1 {
            dest.par_iter_mut().for_each(|value| *value = value.swap_bytes());
        }
        Ok(())
    }

    /// All values in a new vector.
    pub(super) fn to_vec<T: Scalar>(&self) -> Result<Vec<T>, ArrayError> {
        let mut values = large_pages::zeros(self.count(size_of::<T>())?);
        self.decode(&mut values)?;
        Ok(values)
    }
}

fn decode_blocks(
    coded: Coded<'_>,
    table: &BlockTable,
    compressor: Compressor,
    dest: &mut [u8],
) -> Result<(), ArrayError> {
    let compressed = table.compressed();
    let source = coded.bytes_of_run(compressed)?;
    let block = |(index, (range, part)): (usize, (Range<usize>, &mut [u8]))| {
        let block = source.get(range).unwrap_or_default();
        let result = compressor.decompress(block, part);
        result.map_err(|problem| ArrayError::Decompression { block: index, problem })
    };
    let ranges: Vec<_> = table.ranges().collect();
    let parts = dest.par_chunks_mut(table.block_size);
    let jobs = ranges.into_par_iter().zip(parts).enumerate();
    // Of several bad blocks, the first is reported, whichever thread is faster.
    jobs.map(block).collect::<Vec<_>>().into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(order: ByteOrder, compressor: Option<&str>) -> Layout {
        Layout { order, word: HeaderWord::U32, compressor: compressor.map(str::to_owned) }
    }

    fn coded(bytes: &[u8], coding: Coding) -> Coded<'_> {
        Coded { bytes, offset: 0, coding }
    }

    #[test]
    fn raw_in_both_byte_orders() {
        let little = [4, 0, 0, 0, 1, 0, 2, 0];
        let layout_little = layout(ByteOrder::Little, None);
        let payload = Payload::binary(coded(&little, Coding::Raw), &layout_little).unwrap();
        assert_eq!(payload.to_vec::<u16>(), Ok(vec![1, 2]));
        let big = [0, 0, 0, 4, 0, 1, 0, 2];
        let layout_big = layout(ByteOrder::Big, None);
        let payload = Payload::binary(coded(&big, Coding::Raw), &layout_big).unwrap();
        assert_eq!(payload.to_vec::<u16>(), Ok(vec![1, 2]));
    }

    #[test]
    fn base64_with_the_header_in_or_before_the_run() {
        let layout = layout(ByteOrder::Little, None);
        for text in [&b"CAAAAAAAAAAAAPg/"[..], b"CAAAAA==AAAAAAAA+D8=", b" CAAA\nAA== AAAAAAAA+D8="]
        {
            let payload = Payload::binary(coded(text, Coding::Base64), &layout).unwrap();
            assert_eq!(payload.to_vec::<f64>(), Ok(vec![1.5]));
        }
        let one_byte = Payload::binary(coded(b"AQAAAEE=", Coding::Base64), &layout).unwrap();
        assert_eq!(one_byte.to_vec::<u8>(), Ok(vec![b'A']));
        let none = Payload::binary(coded(b"AAAAAA==", Coding::Base64), &layout).unwrap();
        assert_eq!(none.to_vec::<u8>(), Ok(vec![]));
    }

    #[test]
    fn compressed_in_several_blocks() {
        let numbers: Vec<u32> = (0..2500).collect();
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        let blocks: Vec<_> =
            bytes.chunks(4000).map(|chunk| Compressor::Lz4.compress(chunk).unwrap()).collect();
        let sizes = blocks.iter().map(|block| block.len() as u32);
        let words = [3, 4000, 2000].into_iter().chain(sizes);
        let mut file: Vec<u8> = words.flat_map(u32::to_le_bytes).collect();
        file.extend(blocks.concat());
        let layout = layout(ByteOrder::Little, Some("vtkLZ4DataCompressor"));
        let payload = Payload::binary(coded(&file, Coding::Raw), &layout).unwrap();
        assert_eq!(payload.to_vec::<u32>(), Ok(numbers));
        assert!(payload.decode(&mut [0u32; 7]).is_err());
    }

    #[test]
    fn promises_beyond_the_file_are_refused_at_once() {
        let huge = [0xFF; 8];
        let plain = layout(ByteOrder::Little, None);
        let wide = Layout { word: HeaderWord::U64, ..plain.clone() };
        for layout in [plain, wide] {
            assert!(Payload::binary(coded(&huge, Coding::Raw), &layout).is_err());
        }
    }

    #[test]
    fn parts_of_a_value_are_refused() {
        let file = [3, 0, 0, 0, 1, 2, 3];
        let layout = layout(ByteOrder::Little, None);
        let payload = Payload::binary(coded(&file, Coding::Raw), &layout).unwrap();
        let error = payload.to_vec::<u16>().unwrap_err();
        assert_eq!(error, ArrayError::PartOfValue { bytes: 3, size: 2 });
    }

    #[test]
    fn unknown_compressors_are_named() {
        let layout = layout(ByteOrder::Little, Some("vtkZstdDataCompressor"));
        let error = Payload::binary(coded(&[0; 8], Coding::Raw), &layout).unwrap_err();
        assert!(error.to_string().contains("vtkZstdDataCompressor"));
    }
}
