//! The header of a compressed array: how many blocks, and how large.

use super::compression::Compressor;
use super::encoding::{ByteOrder, Coded, HeaderWord};
use super::error::ArrayError;

/// The blocks of one compressed array, checked against what the file can hold.
#[derive(Debug, PartialEq)]
pub(super) struct BlockTable {
    /// Decompressed bytes of every block but the last.
    pub(super) block_size: usize,
    /// Decompressed bytes of all blocks together.
    pub(super) total: usize,
    /// Where each compressed block ends, counted from the beginning of the first.
    pub(super) ends: Vec<usize>,
}

impl BlockTable {
    /// Reads `[blocks][block size][last block's size][compressed sizes...]`, which form a
    /// run of their own, and returns what comes after it. A last size of 0 stands for a
    /// full block; no blocks stand for an empty array.
    pub(super) fn read<'a>(
        coded: Coded<'a>,
        word: HeaderWord,
        order: ByteOrder,
        compressor: Compressor,
    ) -> Result<(Self, Coded<'a>), ArrayError> {
        let first = coded.peek(word.size())?;
        let blocks = word.words(&first, order).next().unwrap_or(0);
        if blocks == 0 {
            return Ok((Self::empty(), coded));
        }
        let too_large =
            || ArrayError::TooLarge { offset: coded.offset, promised: format!("{blocks} blocks") };
        let blocks = usize::try_from(blocks).map_err(|_| too_large())?;
        let words = blocks.checked_add(3).ok_or_else(too_large)?;
        let header = words.checked_mul(word.size()).ok_or_else(too_large)?;
        coded.check_room(header).map_err(|_| too_large())?;
        let bytes = coded.peek(header)?;
        let words = word.words(&bytes, order).skip(1);
        let bad = ArrayError::BlockSizes { offset: coded.offset };
        let table = Self::from_words(words, blocks).ok_or(bad)?;
        let payload = coded.after(header)?;
        table.check(&payload, compressor)?;
        Ok((table, payload))
    }

    fn empty() -> Self {
        Self { block_size: 1, total: 0, ends: Vec::new() }
    }

    /// From the words after the first; `None` where they contradict each other.
    fn from_words(words: impl Iterator<Item = u64>, blocks: usize) -> Option<Self> {
        let mut words = words.map(|word| usize::try_from(word).ok());
        let block_size = words.next()??;
        let last = words.next()??;
        let last = if last == 0 { block_size } else { last };
        if block_size == 0 || last > block_size {
            return None;
        }
        let mut ends = Vec::with_capacity(blocks);
        let mut end = 0usize;
        for size in words {
            end = end.checked_add(size?)?;
            ends.push(end);
        }
        let full = ends.len().checked_sub(1)?.checked_mul(block_size)?;
        Some(Self { block_size, total: full.checked_add(last)?, ends })
    }

    /// Compressed bytes of all blocks together.
    pub(super) fn compressed(&self) -> usize {
        self.ends.last().copied().unwrap_or(0)
    }

    /// The place of each compressed block.
    pub(super) fn ranges(&self) -> impl ExactSizeIterator<Item = std::ops::Range<usize>> + '_ {
        let start = |index: usize| index.checked_sub(1).map_or(0, |before| self.ends[before]);
        (0..self.ends.len()).map(move |index| start(index)..self.ends[index])
    }

    /// Refuses blocks beyond the end of the file, and sizes no compressor can reach.
    fn check(&self, payload: &Coded<'_>, compressor: Compressor) -> Result<(), ArrayError> {
        let compressed = self.compressed();
        payload.check_room(compressed)?;
        if self.total / compressor.max_ratio() > compressed {
            return Err(ArrayError::TooLarge {
                offset: payload.offset,
                promised: format!("{} bytes", self.total),
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::encoding::Coding;

    fn read(words: &[u32], payload: usize) -> Result<BlockTable, ArrayError> {
        let mut bytes: Vec<u8> = words.iter().flat_map(|w| w.to_be_bytes()).collect();
        bytes.resize(bytes.len() + payload, 0);
        let coded = Coded { bytes: &bytes, offset: 0, coding: Coding::Raw };
        let compressor = Compressor::Zlib;
        BlockTable::read(coded, HeaderWord::U32, ByteOrder::Big, compressor).map(|(table, _)| table)
    }

    #[test]
    fn sizes_add_up() {
        let table = read(&[3, 100, 7, 10, 0, 30], 40).unwrap();
        assert_eq!((table.block_size, table.total), (100, 207));
        let ranges: Vec<_> = table.ranges().collect();
        assert_eq!(ranges, [0..10, 10..10, 10..40]);
    }

    #[test]
    fn a_last_size_of_zero_is_a_full_block() {
        assert_eq!(read(&[1, 100, 0, 10], 10).unwrap().total, 100);
        assert_eq!(read(&[2, 100, 0, 10, 10], 20).unwrap().total, 200);
    }

    #[test]
    fn no_blocks_are_no_bytes() {
        assert_eq!(read(&[0], 0).unwrap().total, 0);
        assert_eq!(read(&[0, 32768, 0], 0).unwrap().total, 0);
    }

    #[test]
    fn contradictions_are_refused() {
        let bad = |words: &[u32]| read(words, 40).unwrap_err();
        assert!(matches!(bad(&[1, 100, 101, 10]), ArrayError::BlockSizes { .. }));
        assert!(matches!(bad(&[1, 0, 0, 10]), ArrayError::BlockSizes { .. }));
        assert!(matches!(bad(&[u32::MAX, 8, 0]), ArrayError::TooLarge { .. }));
        assert!(matches!(bad(&[1, 100, 0, 41]), ArrayError::CutShort { .. }));
        assert!(matches!(bad(&[1, 50_000, 0, 40]), ArrayError::TooLarge { .. }));
        assert!(matches!(read(&[], 2).unwrap_err(), ArrayError::CutShort { .. }));
    }
}
