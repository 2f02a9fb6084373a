//! Base64 runs: white space tolerated, long ones on all threads.

use super::error::ArrayError;
use base64_simd::{Out, STANDARD};
use rayon::prelude::*;
use std::borrow::Cow;
use std::io::{self, Write};

/// Characters of one chunk that a thread decodes; a multiple of 4.
const CHUNK: usize = 1 << 17;

/// The characters that `count` bytes take, padding included.
pub(super) fn coded_len(count: usize) -> Option<usize> {
    count.div_ceil(3).checked_mul(4)
}

/// The next `count` characters that are not white space, and how far they reach into
/// `bytes`; `None` where there are fewer.
pub(super) fn take(bytes: &[u8], count: usize) -> Option<(Cow<'_, [u8]>, usize)> {
    let is_blank = |byte: &u8| byte.is_ascii_whitespace();
    let start = bytes.iter().position(|byte| !is_blank(byte)).unwrap_or(0);
    let plain = bytes.get(start..start.checked_add(count)?)?;
    // Folding without a branch lets the compiler use wide registers.
    if !plain.iter().fold(false, |any, byte| any | is_blank(byte)) {
        return Some((Cow::Borrowed(plain), start + count));
    }
    let mut chars = Vec::with_capacity(count);
    let mut used = 0;
    for (at, byte) in bytes.iter().enumerate().filter(|(_, byte)| !is_blank(byte)) {
        if chars.len() == count {
            break;
        }
        chars.push(*byte);
        used = at + 1;
    }
    (chars.len() == count).then_some((Cow::Owned(chars), used))
}

/// Decodes a short run. `offset` is its place in the file, for the message.
pub(super) fn decode(chars: &[u8], offset: usize) -> Result<Vec<u8>, ArrayError> {
    STANDARD.decode_to_vec(chars).map_err(|_| ArrayError::BadBase64 { offset })
}

/// Decodes a whole run without its first `skip` bytes into `dest`, which it fills.
pub(super) fn decode_into(
    chars: &[u8],
    skip: usize,
    dest: &mut [u8],
    offset: usize,
) -> Result<(), ArrayError> {
    // Whole groups of 3 bytes are skipped unseen; the group that is cut goes by hand.
    let chars = chars.get(skip / 3 * 4..).unwrap_or_default();
    let (first, rest) = chars.split_at(chars.len().min(if skip.is_multiple_of(3) { 0 } else { 4 }));
    let group = decode(first, offset)?;
    let seen = group.get(skip % 3..).unwrap_or_default();
    let count = seen.len().min(dest.len());
    let (head, tail) = dest.split_at_mut(count);
    head.copy_from_slice(&seen[..count]);
    if coded_len(tail.len()) != Some(rest.len()) {
        return Err(ArrayError::BadBase64 { offset });
    }
    rest.par_chunks(CHUNK)
        .zip(tail.par_chunks_mut(CHUNK / 4 * 3))
        .enumerate()
        .map(|(index, (from, to))| decode_exactly(from, to, offset + index * CHUNK))
        .reduce(|| Ok(()), |left, right| left.and(right))
}

/// Decodes characters that make exactly `dest.len()` bytes.
fn decode_exactly(chars: &[u8], dest: &mut [u8], offset: usize) -> Result<(), ArrayError> {
    let bad = ArrayError::BadBase64 { offset };
    // The decoder panics where its output is too short.
    if STANDARD.decoded_length(chars).ok() != Some(dest.len()) {
        return Err(bad);
    }
    STANDARD.decode(chars, Out::from_slice(dest)).map_err(|_| bad).map(|_| ())
}

/// Writes everything that is written to it as one base64 run.
pub(super) struct Encoder<W: Write> {
    out: W,
    /// Bytes that do not fill a group of 3 yet.
    pending: Vec<u8>,
    text: Vec<u8>,
}

impl<W: Write> Encoder<W> {
    /// Begins a run.
    pub(super) fn new(out: W) -> Self {
        Self { out, pending: Vec::with_capacity(3), text: Vec::new() }
    }

    /// Ends the run, padded.
    pub(super) fn finish(mut self) -> io::Result<()> {
        let pending = std::mem::take(&mut self.pending);
        self.encode(&pending)
    }

    fn encode(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.text.clear();
        STANDARD.encode_append(bytes, &mut self.text);
        self.out.write_all(&self.text)
    }
}

impl<W: Write> Write for Encoder<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let missing = (3 - self.pending.len()) % 3;
        let (first, rest) = bytes.split_at(missing.min(bytes.len()));
        self.pending.extend_from_slice(first);
        if self.pending.len() == 3 {
            let group = std::mem::take(&mut self.pending);
            self.encode(&group)?;
        }
        let (groups, rest) = rest.split_at(rest.len() / 3 * 3);
        self.encode(groups)?;
        self.pending.extend_from_slice(rest);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_overflow() {
        assert_eq!([0, 1, 3, 4].map(coded_len), [0, 4, 4, 8].map(Some));
        assert_eq!(coded_len(usize::MAX), None);
    }

    #[test]
    fn white_space_is_passed_over() {
        let (chars, used) = take(b" \nQU\n JD RDef", 6).unwrap();
        assert_eq!((&chars[..], used), (&b"QUJDRD"[..], 11));
        let (chars, used) = take(b"\tQUJDR", 4).unwrap();
        assert_eq!((&chars[..], used), (&b"QUJD"[..], 5));
        assert!(take(b"QU JD", 5).is_none());
        assert!(take(b"", 1).is_none());
        assert!(take(b"", 0).is_some());
    }

    #[test]
    fn any_skip_of_any_run() {
        let bytes: Vec<u8> = (0..=255).cycle().take(3 * CHUNK).collect();
        for len in (0..20).chain([CHUNK, bytes.len()]) {
            let coded = STANDARD.encode_to_string(&bytes[..len]);
            for skip in (0..=8).filter(|skip| *skip <= len) {
                let mut dest = vec![0; len - skip];
                decode_into(coded.as_bytes(), skip, &mut dest, 0).unwrap();
                assert_eq!(dest, bytes[skip..len], "{skip} of {len}");
            }
        }
    }

    #[test]
    fn bad_characters_and_wrong_padding_are_refused() {
        for coded in ["QU!D", "QU==", "Q===", "QUJ"] {
            let error = decode_into(coded.as_bytes(), 0, &mut [0; 3], 7).unwrap_err();
            assert_eq!(error, ArrayError::BadBase64 { offset: 7 }, "{coded}");
        }
    }

    #[test]
    fn runs_padded_too_early_are_refused() {
        // The group that the skip cuts holds one byte, not the three that are due.
        for chars in [&b"QQ=="[..], b"QQ==QUJD"] {
            let mut dest = vec![0; chars.len() / 4 * 3 - 1];
            assert!(decode_into(chars, 1, &mut dest, 0).is_err());
        }
    }

    #[test]
    fn pieces_make_one_run() {
        let bytes: Vec<u8> = (0..=255).collect();
        for step in 1..=9 {
            let mut text = Vec::new();
            let mut encoder = Encoder::new(&mut text);
            for part in bytes.chunks(step) {
                encoder.write_all(part).unwrap();
            }
            encoder.finish().unwrap();
            assert_eq!(text, STANDARD.encode_to_string(&bytes).into_bytes());
        }
    }
}
