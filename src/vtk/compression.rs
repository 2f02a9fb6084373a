//! The three compressors of VTK, one block at a time.

use super::error::ArrayError;
use flate2::{Compression, Decompress, FlushDecompress, Status};
use lzma_rust2::{CheckType, XzOptions, XzReader, XzWriter};
use std::io::{self, Read, Write};

/// The memory one LZMA block may ask for, in KiB: the dictionary of the highest preset
/// (64 MiB) and what the decoder needs besides.
const LZMA_MEMORY: u32 = 66 << 10;

/// The LZMA preset for writing, VTK's own default.
const LZMA_PRESET: u32 = 5;

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
            Self::Lz4 => Ok(lz4_flex::block::compress(bytes)),
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

/// Returns how many bytes of `dest` were filled.
fn unxz(block: &[u8], dest: &mut [u8]) -> io::Result<usize> {
    let mut reader = XzReader::new_mem_limit(block, false, LZMA_MEMORY);
    reader.read_exact(dest)?;
    // Reading past the end makes the reader check the stream's index and footer.
    match reader.read(&mut [0])? {
        0 => Ok(dest.len()),
        more => Ok(dest.len() + more),
    }
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

    fn crc32(bytes: &[u8]) -> u32 {
        let step = |crc: u32, _| (crc >> 1) ^ (0xEDB8_8320 * (crc & 1));
        let byte = |crc: u32, byte: &u8| (0..8).fold(crc ^ u32::from(*byte), step);
        !bytes.iter().fold(!0, byte)
    }

    #[test]
    fn huge_dictionaries_are_refused() {
        let mut block = Compressor::Lzma.compress(&[7; 1000]).unwrap();
        // The header of the first block follows the 12 bytes of the stream's; it says how
        // long it is in words of 4 bytes, names the filter LZMA2 (0x21), and ends with a
        // checksum.
        let end = 12 + (usize::from(block[12]) + 1) * 4;
        let filter = (12..end).find(|at| block[*at..].starts_with(&[0x21, 1])).unwrap();
        // The code for a dictionary of 4 GiB.
        block[filter + 2] = 40;
        let checksum = crc32(&block[12..end - 4]);
        block[end - 4..end].copy_from_slice(&checksum.to_le_bytes());
        let error = Compressor::Lzma.decompress(&block, &mut [0; 1000]);
        assert!(error.unwrap_err().contains("mem_limit"));
    }
}
