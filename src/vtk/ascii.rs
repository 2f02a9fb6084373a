//! Ascii arrays: numbers separated by white space, read on all threads.

use super::error::ArrayError;
use super::scalar::Scalar;
use rayon::prelude::*;
use std::ops::Range;

/// About how many bytes of text one thread reads at a time.
const CHUNK: usize = 1 << 16;

/// The text of an ascii array, cut into chunks whose numbers are counted.
#[derive(Debug)]
pub(super) struct AsciiText<'a> {
    text: &'a [u8],
    /// Where the text begins in the file, for messages.
    offset: usize,
    chunks: Vec<(Range<usize>, usize)>,
}

impl<'a> AsciiText<'a> {
    /// Counts the numbers of `text`.
    pub(super) fn new(text: &'a [u8], offset: usize) -> Self {
        let count = |range: Range<usize>| (range.clone(), count_tokens(&text[range]));
        Self { text, offset, chunks: split(text).into_par_iter().map(count).collect() }
    }

    /// How many numbers there are.
    pub(super) fn count(&self) -> usize {
        self.chunks.iter().map(|(_, count)| count).sum()
    }

    /// Reads the numbers into `dest`, which must be as long as [`count`](Self::count).
    pub(super) fn parse<T: Scalar>(&self, mut dest: &mut [T]) -> Result<(), ArrayError> {
        let mut jobs = Vec::with_capacity(self.chunks.len());
        for (range, count) in &self.chunks {
            let (part, rest) = dest.split_at_mut((*count).min(dest.len()));
            jobs.push((range.clone(), part));
            dest = rest;
        }
        // Of several bad numbers, the first is reported, whichever thread is faster.
        let results = jobs.into_par_iter().map(|(range, part)| self.parse_chunk(range, part));
        results.collect::<Vec<_>>().into_iter().collect()
    }

    fn parse_chunk<T: Scalar>(
        &self,
        range: Range<usize>,
        dest: &mut [T],
    ) -> Result<(), ArrayError> {
        let tokens = self.text[range].split(u8::is_ascii_whitespace);
        let tokens = tokens.filter(|token| !token.is_empty());
        for (value, token) in dest.iter_mut().zip(tokens) {
            let number = std::str::from_utf8(token).ok().and_then(T::parse);
            *value = number.ok_or_else(|| self.bad_number::<T>(token))?;
        }
        Ok(())
    }

    fn bad_number<T: Scalar>(&self, token: &[u8]) -> ArrayError {
        let at = token.as_ptr() as usize - self.text.as_ptr() as usize;
        ArrayError::BadNumber {
            token: String::from_utf8_lossy(&token[..token.len().min(40)]).into_owned(),
            offset: self.offset + at,
            expected: T::TYPE,
        }
    }
}

/// Cuts text into chunks that end between numbers.
fn split(text: &[u8]) -> Vec<Range<usize>> {
    let mut chunks = Vec::new();
    let mut start = 0;
    while start < text.len() {
        let rest = text.get(start + CHUNK..).unwrap_or_default();
        let blank = rest.iter().position(u8::is_ascii_whitespace);
        let end = blank.map_or(text.len(), |at| start + CHUNK + at);
        chunks.push(start..end);
        start = end;
    }
    chunks
}

/// Counts the places where a number begins.
fn count_tokens(text: &[u8]) -> usize {
    let mut blank_before = true;
    let begins = |byte: &u8| {
        let blank = byte.is_ascii_whitespace();
        let begins = blank_before && !blank;
        blank_before = blank;
        usize::from(begins)
    };
    text.iter().map(begins).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read<T: Scalar>(text: &str) -> Result<Vec<T>, ArrayError> {
        let text = AsciiText::new(text.as_bytes(), 1000);
        let mut values = vec![T::zeroed(); text.count()];
        text.parse(&mut values)?;
        Ok(values)
    }

    #[test]
    fn numbers_between_any_white_space() {
        assert_eq!(read::<i32>("\n 1 -2\t3\r\n"), Ok(vec![1, -2, 3]));
        assert_eq!(read::<f32>("1e-3 .5 inf"), Ok(vec![1e-3, 0.5, f32::INFINITY]));
        assert_eq!(read::<u8>("   "), Ok(vec![]));
        assert_eq!(read::<u8>(""), Ok(vec![]));
    }

    #[test]
    fn bad_numbers_are_named_with_their_place() {
        let error = read::<u8>("1 2  x3 y").unwrap_err();
        assert_eq!(error.to_string(), "'x3' at byte 1005 is not a number of type UInt8");
    }

    #[test]
    fn long_texts_are_cut_between_numbers() {
        let numbers: Vec<u64> = (0..100_000).map(|i| i * i * 7919).collect();
        let words: Vec<_> = numbers.iter().map(u64::to_string).collect();
        assert_eq!(read::<u64>(&words.join("\n ")), Ok(numbers));
        let one = "9".repeat(3 * CHUNK);
        assert_eq!(AsciiText::new(one.as_bytes(), 0).count(), 1);
    }
}
