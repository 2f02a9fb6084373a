//! A quick hash of edges.

use std::hash::{BuildHasherDefault, Hasher};

/// A map of edges, which are two numbers. The standard hash withstands keys that were chosen to
/// collide, and takes most of the time of such a map.
pub type EdgeMap<T> = std::collections::HashMap<[u32; 2], T, BuildHasherDefault<EdgeHasher>>;

/// Fibonacci hashing (Knuth, The Art of Computer Programming, 6.4), eight bytes at a time.
#[derive(Clone, Copy, Debug, Default)]
pub struct EdgeHasher(u64);

/// 2^64 divided by the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

impl Hasher for EdgeHasher {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            let mixed = (self.0 ^ u64::from_le_bytes(word)).wrapping_mul(GOLDEN);
            // the high bits depend on all, the low ones do not
            self.0 = mixed ^ (mixed >> 32);
        }
    }

    /// The length of the edge, always the same.
    fn write_usize(&mut self, _: usize) {}

    fn finish(&self) -> u64 {
        self.0.wrapping_mul(GOLDEN)
    }
}
