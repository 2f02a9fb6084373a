//! Walking through the bytes of a legacy file: words, lines and blocks of numbers.

use super::error::LegacyProblem;
use std::ops::Range;

/// How far a line is looked through for its end: as far as VTK does.
const LINE: usize = 256;

/// What is wrong with a legacy file, and at which byte.
#[derive(Debug)]
pub(super) struct LegacyFlaw {
    pub(super) offset: usize,
    pub(super) problem: LegacyProblem,
}

/// A place in the bytes of a legacy file.
#[derive(Clone)]
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Scanner<'a> {
    /// The beginning of the file.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// The problem with the place where it was met.
    pub(super) fn flaw(&self, problem: LegacyProblem) -> LegacyFlaw {
        LegacyFlaw { offset: self.at, problem }
    }

    fn ends(&self, expected: &'static str) -> LegacyFlaw {
        self.flaw(LegacyProblem::Ends { expected })
    }

    /// How far the file has been read.
    pub(super) fn position(&self) -> usize {
        self.at
    }

    /// What has not been read.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    fn skip_blanks(&mut self) {
        let blanks = self.rest().iter().take_while(|byte| byte.is_ascii_whitespace());
        self.at += blanks.count();
    }

    /// The next word; `None` at the end of the file.
    pub(super) fn next_word(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let rest = self.rest();
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += end;
        rest.get(..end).filter(|word| !word.is_empty())
    }

    /// The next word, which must be there.
    pub(super) fn word(&mut self, expected: &'static str) -> Result<&'a [u8], LegacyFlaw> {
        self.next_word().ok_or_else(|| self.ends(expected))
    }

    /// The next word as a name, decoded: VTK writes blanks and other odd bytes as `%20`.
    pub(super) fn name(&mut self) -> Result<String, LegacyFlaw> {
        self.word("a name").map(decode)
    }

    /// The next word as a number of things.
    pub(super) fn count(&mut self, expected: &'static str) -> Result<usize, LegacyFlaw> {
        let before = self.clone();
        let word = self.word(expected)?;
        let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        number.ok_or_else(|| before.unexpected(word, expected))
    }

    /// The error that `word` is not what should be here.
    pub(super) fn unexpected(&self, word: &[u8], expected: &'static str) -> LegacyFlaw {
        let shown = word.get(..word.len().min(40)).unwrap_or_default();
        let found = String::from_utf8_lossy(shown).into_owned();
        self.flaw(LegacyProblem::Unexpected { found, expected })
    }

    /// Passes over one word, which must be this one in any case.
    pub(super) fn expect(&mut self, word: &'static str) -> Result<(), LegacyFlaw> {
        match self.next_is(word) {
            true => Ok(()),
            false => {
                let before = self.clone();
                let found = self.word(word)?;
                Err(before.unexpected(found, word))
            }
        }
    }

    /// Passes over the next word if it is this one, in any case.
    pub(super) fn next_is(&mut self, word: &str) -> bool {
        let mut ahead = self.clone();
        let found =
            ahead.next_word().is_some_and(|next| next.eq_ignore_ascii_case(word.as_bytes()));
        if found {
            *self = ahead;
        }
        found
    }

    /// The rest of the line without its end; `None` at the end of the file.
    pub(super) fn line(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest();
        if rest.is_empty() {
            return None;
        }
        let end = rest.iter().position(|byte| *byte == b'\n');
        let line = rest.get(..end.unwrap_or(rest.len())).unwrap_or_default();
        self.at += end.map_or(rest.len(), |end| end + 1);
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    }

    /// Passes over the end of a line, behind which a block of bytes begins.
    pub(super) fn end_line(&mut self) -> Result<(), LegacyFlaw> {
        let line = self.rest().iter().take(LINE);
        match line.copied().position(|byte| byte == b'\n') {
            Some(end) => {
                self.at += end + 1;
                Ok(())
            }
            None => Err(self.ends("the end of the line")),
        }
    }

    /// Passes over that many bytes; returns their place.
    pub(super) fn block(&mut self, count: usize) -> Result<Range<usize>, LegacyFlaw> {
        match self.rest().get(..count) {
            Some(_) => {
                let start = self.at;
                self.at += count;
                Ok(start..self.at)
            }
            None => Err(self.ends("the rest of the data")),
        }
    }

    /// Passes over that many words; returns the place of the text they are in.
    pub(super) fn words(&mut self, count: usize) -> Result<Range<usize>, LegacyFlaw> {
        // Each takes a byte, and the blank before it another.
        if count > self.rest().len() {
            return Err(self.ends("the rest of the data"));
        }
        let start = self.at;
        for _ in 0..count {
            self.word("the rest of the data")?;
        }
        Ok(start..self.at)
    }

    /// Passes over the block of one string: two bits that say how wide its length is, the
    /// length, and as many bytes. Returns their place.
    pub(super) fn string(&mut self) -> Result<Range<usize>, LegacyFlaw> {
        let first = self.rest().first().copied().ok_or_else(|| self.ends("a string"))?;
        let width = [8, 4, 2, 1][usize::from(first >> 6)];
        let place = self.block(width)?;
        let bytes = self.bytes.get(place).unwrap_or_default();
        let length = bytes.iter().fold(0u64, |number, byte| number << 8 | u64::from(*byte));
        let flags = if width == 8 { 0 } else { 3u64 << (8 * width - 2) };
        let length = usize::try_from(length & !flags).map_err(|_| self.ends("a string"))?;
        self.block(length)
    }
}

/// Replaces `%20` and the like by the byte they stand for.
pub(super) fn decode(word: &[u8]) -> String {
    let mut bytes = Vec::with_capacity(word.len());
    let mut rest = word;
    while let Some((first, after)) = rest.split_first() {
        let digits = after.get(..2).filter(|_| *first == b'%');
        let digits = digits.filter(|digits| digits.iter().all(u8::is_ascii_hexdigit));
        let digits = digits.and_then(|digits| std::str::from_utf8(digits).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = after.get(2..).unwrap_or_default();
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_lines_and_blocks() {
        let mut scanner = Scanner::new(b" a\tB 7\r\n  x y\r\n\x01\x02 9");
        assert_eq!(scanner.next_word(), Some(&b"a"[..]));
        assert!(!scanner.next_is("c"));
        scanner.expect("b").unwrap();
        assert_eq!(scanner.count("a count").unwrap(), 7);
        scanner.end_line().unwrap();
        assert_eq!(scanner.line(), Some(&b"  x y"[..]));
        assert_eq!(scanner.block(2).unwrap(), 15..17);
        assert!(scanner.block(3).is_err());
        assert_eq!(scanner.words(1).unwrap(), 17..19);
        assert!(scanner.words(usize::MAX).is_err());
        assert_eq!((scanner.next_word(), scanner.line()), (None, None));
    }

    #[test]
    fn wrong_words_are_named_with_their_place() {
        let mut scanner = Scanner::new(b"ab cd");
        scanner.next_word();
        let flaw = scanner.count("a count").unwrap_err();
        assert_eq!(flaw.offset, 2);
        assert_eq!(flaw.problem.to_string(), "'cd' where a count should be");
        let flaw = scanner.expect("LOOKUP_TABLE").unwrap_err();
        assert!(flaw.problem.to_string().contains("the file ends"), "{}", flaw.problem);
    }

    #[test]
    fn strings_have_lengths_of_four_widths() {
        let mut bytes = vec![0xC1, b'a', 0x80, 1, b'b', 0x40, 0, 0, 1, b'c'];
        bytes.extend([0, 0, 0, 0, 0, 0, 0, 1, b'd', 0xC2, b'e']);
        let mut scanner = Scanner::new(&bytes);
        for expected in b"abcd" {
            let place = scanner.string().unwrap();
            assert_eq!(bytes[place], [*expected]);
        }
        assert!(scanner.string().is_err());
    }

    #[test]
    fn names_are_decoded() {
        assert_eq!(decode(b"a%20b%C3%A9%"), "a bé%");
        assert_eq!(decode(b"%zz%+1%4"), "%zz%+1%4");
    }
}
