//! The three compressors of VTK, one block at a time.

use super::error::ArrayError;
use flate2::{Compression, Decompress, FlushDecompress, Status};
use lzma_rust2::{CheckType, XzOptions, XzReader, XzWriter};
use std::cell::RefCell;
use std::io::{self, Read, Write};

/// The memory one LZMA block may ask for where its head is not as usual, in KiB: the
/// dictionary of the highest preset (64 MiB) and what the decoder needs besides.
const LZMA_MEMORY: u32 = 66 << 10;

/// The LZMA preset for writing. VTK takes 5; with our larger blocks 4 is chosen for speed,
/// and makes smaller files still.
const LZMA_PRESET: u32 = 4;

/// A compressor of VTK's files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compressor {
    /// A zlib stream per block.
    Zlib,
    /// A bare LZ4 block.
    Lz4,
    /// An .xz stream per block.
    Lzma,
}

impl Compressor {
    /// The compressor of that name in a file.
    pub(super) fn from_name(name: &str) -> Result<Self, ArrayError> {
        [Self::Zlib, Self::Lz4, Self::Lzma]
            .into_iter()
            .find(|compressor| compressor.name() == name)
            .ok_or_else(|| ArrayError::UnknownCompressor(name.to_owned()))
    }

    /// The name in a file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Zlib => "vtkZLibDataCompressor",
            Self::Lz4 => "vtkLZ4DataCompressor",
            Self::Lzma => "vtkLZMADataCompressor",
        }
    }

    /// No byte of compressed data ever makes more bytes than this: a guard against
    /// headers that promise what cannot be.
    pub(super) fn max_ratio(self) -> usize {
        match self {
            // A match of 258 bytes takes at least 2 bits.
            Self::Zlib => 1032,
            // A length byte stands for 255 bytes.
            Self::Lz4 => 255,
            // A match of 273 bytes takes at least 14 binary decisions of 0.022 bits.
            Self::Lzma => 8192,
        }
    }

    /// Bytes of one block when writing: small enough to keep every thread busy, large enough
    /// to compress well. A whole number of values of any type.
    pub(super) fn block_size(self) -> usize {
        match self {
            // Below 64 KiB, the encoder's table has words of half the size. (VTK asks its
            // encoder for an acceleration of 5, which ours has not: a little larger files,
            // a tenth faster on one thread.)
            Self::Lz4 => (1 << 16) - 8,
            Self::Zlib | Self::Lzma => 1 << 18,
        }
    }

    /// Decompresses one block, which must fill `dest` exactly.
    pub(super) fn decompress(self, block: &[u8], dest: &mut [u8]) -> Result<(), String> {
        let filled = match self {
            Self::Zlib => inflate(block, dest),
            Self::Lz4 => {
                lz4_flex::block::decompress_into(block, dest).map_err(|error| error.to_string())
            }
            Self::Lzma => unxz(block, dest).map_err(|error| error.to_string()),
        }?;
        if filled == dest.len() {
            return Ok(());
        }
        Err(format!("{filled} bytes where {} are promised", dest.len()))
    }

    /// Compresses one block.
    ///
    /// # Errors
    /// Only what the compressor itself reports; none is known for output in memory.
    pub(super) fn compress(self, bytes: &[u8]) -> io::Result<Vec<u8>> {
        match self {
            Self::Zlib => deflate(bytes),
            Self::Lz4 => Ok(lz4(bytes)),
            Self::Lzma => xz(bytes),
        }
    }
}

/// Returns how many bytes of `dest` were filled.
fn inflate(block: &[u8], dest: &mut [u8]) -> Result<usize, String> {
    let mut state = Decompress::new(true);
    let status = state.decompress(block, dest, FlushDecompress::Finish);
    match status.map_err(|error| error.to_string())? {
        Status::StreamEnd => Ok(usize::try_from(state.total_out()).unwrap_or(0)),
        _ => Err(String::from("the zlib stream does not end with the block")),
    }
}

fn deflate(bytes: &[u8]) -> io::Result<Vec<u8>> {
    // VTK takes 5; 3 is chosen for speed.
    let level = Compression::new(3);
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), level);
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// Compresses in one buffer a thread, and keeps of it what is used: what the encoder might
/// need at worst would else be new memory for every block.
fn lz4(bytes: &[u8]) -> Vec<u8> {
    thread_local! {
        static BUFFER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    }
    BUFFER.with_borrow_mut(|buffer| {
        let most = lz4_flex::block::get_maximum_output_size(bytes.len());
        if buffer.len() < most {
            buffer.resize(most, 0);
        }
        let used = lz4_flex::block::compress_into(bytes, buffer);
        buffer.get(..used.unwrap_or(0)).unwrap_or_default().to_vec()
    })
}

/// Returns how many bytes of `dest` were filled.
fn unxz(block: &[u8], dest: &mut [u8]) -> io::Result<usize> {
    let head = xz_head(block, dest.len()).unwrap_or_default();
    let rest = block.get(head.len()..).unwrap_or_default();
    let mut reader = XzReader::new_mem_limit(head.chain(rest), false, LZMA_MEMORY);
    reader.read_exact(dest)?;
    // Reading past the end makes the reader check the stream's index and footer.
    match reader.read(&mut [0])? {
        0 => Ok(dest.len()),
        more => Ok(dest.len() + more),
    }
}

/// The head of an .xz stream with a dictionary no larger than `len`, the decompressed size:
/// what lies further back is never asked for. Encoders name one of 8 MiB for blocks of
/// 32 KiB, and setting up that much memory takes longer than decompressing. `None` where the
/// head is not as usual, or already modest.
fn xz_head(block: &[u8], len: usize) -> Option<Vec<u8>> {
    const STREAM_HEAD: usize = 12;
    const LZMA2: [u8; 2] = [0x21, 1];
    let words = usize::from(*block.get(STREAM_HEAD)?);
    let end = STREAM_HEAD + 4 * words;
    let mut head = block.get(..end + 4)?.to_vec();
    let flags = *head.get(STREAM_HEAD + 1)?;
    // One filter, and no sizes before it.
    let filter = head.get(STREAM_HEAD + 2..STREAM_HEAD + 4)?;
    if flags != 0 || filter != LZMA2 || head.get(end..)? != crc32(&head[STREAM_HEAD..end]) {
        return None;
    }
    let code = head.get_mut(STREAM_HEAD + 4)?;
    let modest = (0..*code).find(|code| dictionary(*code) >= len as u64)?;
    *code = modest;
    let sum = crc32(head.get(STREAM_HEAD..end)?);
    head.get_mut(end..)?.copy_from_slice(&sum);
    Some(head)
}

/// The size of the dictionary that a code stands for: 4, 6, 8, 12, 16 ... KiB.
fn dictionary(code: u8) -> u64 {
    (2 | u64::from(code) & 1) << (u32::from(code) / 2 + 11).min(40)
}

/// The checksum of the head of an .xz block, which is at most 1024 bytes long.
fn crc32(bytes: &[u8]) -> [u8; 4] {
    let step = |crc: u32, _| (crc >> 1) ^ (0xEDB8_8320 * (crc & 1));
    let byte = |crc: u32, byte: &u8| (0..8).fold(crc ^ u32::from(*byte), step);
    (!bytes.iter().fold(!0, byte)).to_le_bytes()
}

fn xz(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut options = XzOptions::with_preset(LZMA_PRESET);
    options.set_check_sum_type(CheckType::Crc32);
    // A dictionary beyond the block would only cost memory.
    let dictionary = bytes.len().next_power_of_two().clamp(1 << 12, 1 << 23);
    options.lzma_options.dict_size = dictionary as u32;
    let mut writer = XzWriter::new(Vec::new(), options)?;
    writer.write_all(bytes)?;
    writer.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Compressor; 3] = [Compressor::Zlib, Compressor::Lz4, Compressor::Lzma];

    #[test]
    fn blocks_come_back() {
        let bytes: Vec<u8> = (0..100_000u32).flat_map(|i| (i / 7).to_le_bytes()).collect();
        for compressor in ALL {
            for len in [1, 4, 1000, bytes.len()] {
                let block = compressor.compress(&bytes[..len]).unwrap();
                let mut dest = vec![0; len];
                compressor.decompress(&block, &mut dest).unwrap();
                assert_eq!(dest, bytes[..len], "{compressor:?} {len}");
            }
        }
    }

    #[test]
    fn blocks_of_another_size_are_refused() {
        for compressor in ALL {
            let block = compressor.compress(&[7; 1000]).unwrap();
            for len in [0, 999, 1001] {
                let result = compressor.decompress(&block, &mut vec![0; len]);
                assert!(result.is_err(), "{compressor:?} {len}");
            }
            let cut = &block[..block.len() - 1];
            assert!(compressor.decompress(cut, &mut [0; 1000]).is_err());
        }
    }

    #[test]
    fn the_best_ratio_stays_below_the_bound() {
        for compressor in ALL {
            let zeros = vec![0; 1 << 24];
            let block = compressor.compress(&zeros).unwrap();
            let ratio = zeros.len() / block.len();
            assert!(ratio < compressor.max_ratio(), "{compressor:?} {ratio}");
        }
    }

    #[test]
    fn names() {
        for compressor in ALL {
            assert_eq!(Compressor::from_name(compressor.name()), Ok(compressor));
        }
        assert!(Compressor::from_name("vtkZstd").is_err());
    }

    /// A block that names the dictionary of that code.
    fn with_dictionary(code: u8, valid: bool) -> Vec<u8> {
        let mut block = Compressor::Lzma.compress(&[7; 1000]).unwrap();
        let end = 12 + usize::from(block[12]) * 4;
        block[16] = code;
        let sum = crc32(&block[12..end]);
        if valid {
            block[end..end + 4].copy_from_slice(&sum);
        }
        block
    }

    #[test]
    fn dictionaries_are_no_larger_than_the_data() {
        assert_eq!([0, 1, 2, 22, 40].map(dictionary), [4096, 6144, 8192, 8 << 20, 2 << 31]);
        let head = xz_head(&with_dictionary(40, true), 7000).unwrap();
        assert_eq!(head[16], 2);
        assert!(xz_head(&with_dictionary(0, true), 1000).is_none());
        for code in [0, 1, 22, 40] {
            let mut dest = [0; 1000];
            Compressor::Lzma.decompress(&with_dictionary(code, true), &mut dest).unwrap();
            assert_eq!(dest, [7; 1000]);
        }
        let wrong = with_dictionary(40, false);
        assert!(Compressor::Lzma.decompress(&wrong, &mut [0; 1000]).is_err());
    }
}
