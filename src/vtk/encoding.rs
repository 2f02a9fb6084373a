//! How numbers lie in the bytes of a file: byte order, header words, raw or base64.

use super::base64;
use super::error::ArrayError;
use std::borrow::Cow;

/// The order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ByteOrder {
    Little,
    Big,
}

impl ByteOrder {
    /// Whether numbers in this order must be turned on this machine.
    pub(super) fn is_foreign(self) -> bool {
        let native = if cfg!(target_endian = "big") { Self::Big } else { Self::Little };
        self != native
    }
}

/// The type of the words in front of every binary array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HeaderWord {
    U32,
    U64,
}

impl HeaderWord {
    /// Bytes of one word.
    pub(super) fn size(self) -> usize {
        match self {
            Self::U32 => 4,
            Self::U64 => 8,
        }
    }

    /// The words in `bytes`; a rest shorter than a word is left out.
    pub(super) fn words(self, bytes: &[u8], order: ByteOrder) -> impl Iterator<Item = u64> + '_ {
        bytes.chunks_exact(self.size()).map(move |word| {
            let append = |number: u64, byte: &u8| number << 8 | u64::from(*byte);
            match order {
                ByteOrder::Little => word.iter().rev().fold(0, append),
                ByteOrder::Big => word.iter().fold(0, append),
            }
        })
    }
}

/// How the bytes of binary arrays are written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coding {
    Raw,
    Base64,
}

/// Coded bytes of the file, from the first header word of one array on, possibly with
/// those of other arrays after them. They consist of runs, each coded on its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coded<'a> {
    /// The coded bytes.
    pub(super) bytes: &'a [u8],
    /// Where they begin in the file, for messages.
    pub(super) offset: usize,
    /// How they are coded.
    pub(super) coding: Coding,
}

impl<'a> Coded<'a> {
    /// The coded bytes that `count` bytes take in a run.
    pub(super) fn coded_len(&self, count: usize) -> Option<usize> {
        match self.coding {
            Coding::Raw => Some(count),
            Coding::Base64 => base64::coded_len(count),
        }
    }

    /// Refuses a run of `count` bytes that the rest of the file cannot hold.
    pub(super) fn check_room(&self, count: usize) -> Result<(), ArrayError> {
        match self.coded_len(count) {
            Some(needed) if needed <= self.bytes.len() => Ok(()),
            needed => Err(self.cut_short(needed.map_or(u64::MAX, |needed| needed as u64))),
        }
    }

    /// The error that the data end too early.
    pub(super) fn cut_short(&self, needed: u64) -> ArrayError {
        ArrayError::CutShort { offset: self.offset, needed, available: self.bytes.len() }
    }

    /// The first `count` bytes of the run that begins here. Fewer only where a padded
    /// base64 run ends earlier.
    pub(super) fn peek(&self, count: usize) -> Result<Cow<'a, [u8]>, ArrayError> {
        self.check_room(count)?;
        match self.coding {
            Coding::Raw => Ok(Cow::Borrowed(self.bytes.get(..count).unwrap_or_default())),
            Coding::Base64 => {
                let (chars, _) = self.chars(count)?;
                base64::decode(&chars, self.offset).map(Cow::Owned)
            }
        }
    }

    /// What lies after a run of `count` bytes.
    pub(super) fn after(&self, count: usize) -> Result<Self, ArrayError> {
        self.check_room(count)?;
        let used = match self.coding {
            Coding::Raw => count,
            Coding::Base64 => self.chars(count)?.1,
        };
        Ok(Self {
            bytes: self.bytes.get(used..).unwrap_or_default(),
            offset: self.offset + used,
            coding: self.coding,
        })
    }

    /// All `count` bytes of the run that begins here.
    pub(super) fn bytes_of_run(&self, count: usize) -> Result<Cow<'a, [u8]>, ArrayError> {
        if self.coding == Coding::Raw {
            return self.peek(count);
        }
        self.check_room(count)?;
        let mut bytes = vec![0; count];
        self.decode(0, &mut bytes)?;
        Ok(Cow::Owned(bytes))
    }

    /// Fills `dest` with the bytes of the run that begins here, past its first `skip`.
    pub(super) fn decode(&self, skip: usize, dest: &mut [u8]) -> Result<(), ArrayError> {
        let count = skip.saturating_add(dest.len());
        self.check_room(count)?;
        match self.coding {
            Coding::Raw => {
                let source = self.bytes.get(skip..count);
                copy_parallel(source.unwrap_or_default(), dest);
                Ok(())
            }
            Coding::Base64 => {
                let (chars, _) = self.chars(count)?;
                base64::decode_into(&chars, skip, dest, self.offset)
            }
        }
    }

    /// The base64 characters of a run of `count` bytes, without white space, and how far
    /// they reach.
    fn chars(&self, count: usize) -> Result<(Cow<'a, [u8]>, usize), ArrayError> {
        let needed = self.coded_len(count).unwrap_or(usize::MAX);
        base64::take(self.bytes, needed).ok_or_else(|| self.cut_short(needed as u64))
    }
}

/// Copies equally long slices, on all threads where they are long.
fn copy_parallel(source: &[u8], dest: &mut [u8]) {
    use rayon::prelude::*;
    const CHUNK: usize = 1 << 20;
    dest.par_chunks_mut(CHUNK).zip(source.par_chunks(CHUNK)).for_each(|(to, from)| {
        let count = to.len().min(from.len());
        to[..count].copy_from_slice(&from[..count]);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_in_both_orders() {
        let words = |word: HeaderWord, order| -> Vec<u64> {
            word.words(&[1, 0, 0, 0, 0, 0, 0, 2, 9], order).collect()
        };
        assert_eq!(words(HeaderWord::U32, ByteOrder::Little), [1, 2 << 24]);
        assert_eq!(words(HeaderWord::U32, ByteOrder::Big), [1 << 24, 2]);
        assert_eq!(words(HeaderWord::U64, ByteOrder::Little), [1 | 2 << 56]);
        assert_eq!(words(HeaderWord::U64, ByteOrder::Big), [1 << 56 | 2]);
    }

    #[test]
    fn one_base64_run_holds_header_and_data() {
        // Four header bytes (8 as a little-endian word), then the float64 1.5.
        let coded = Coded { bytes: b"CAAAAAAAAAAAAPg/rest", offset: 100, coding: Coding::Base64 };
        assert_eq!(coded.peek(4).unwrap()[..4], [8, 0, 0, 0]);
        let mut value = [0; 8];
        coded.decode(4, &mut value).unwrap();
        assert_eq!(f64::from_le_bytes(value), 1.5);
        assert_eq!(coded.after(12).unwrap().bytes, b"rest");
        assert_eq!(coded.after(12).unwrap().offset, 116);
    }

    #[test]
    fn runs_longer_than_the_file_are_refused() {
        for coding in [Coding::Raw, Coding::Base64] {
            let coded = Coded { bytes: b"AAAA", offset: 0, coding };
            assert!(matches!(coded.peek(5), Err(ArrayError::CutShort { .. })));
            assert!(coded.after(usize::MAX).is_err());
            assert!(coded.decode(usize::MAX, &mut [0; 2]).is_err());
        }
    }
}
