//! Memory for large arrays, in large pages where the system has them.
//!
//! The system gives memory page by page as it is first written. With its usual pages of four KiB
//! that took a fifth of the time from a file of a million tetrahedra to a contour; pages of two
//! MiB take a tenth of that. Linux has them for who asks, in advance.

use bytemuck::Zeroable;

/// So many zeros.
pub(crate) fn zeros<T: Zeroable + Copy>(count: usize) -> Vec<T> {
    in_large_pages(vec![T::zeroed(); count])
}

/// A vector that holds nothing yet, with room for so many.
pub(crate) fn with_room<T>(count: usize) -> Vec<T> {
    in_large_pages(Vec::with_capacity(count))
}

/// All of these.
pub(crate) fn collected<T>(items: impl ExactSizeIterator<Item = T>) -> Vec<T> {
    let mut vector = with_room(items.len());
    vector.extend(items);
    vector
}

#[cfg(target_os = "linux")]
#[allow(
    unsafe_code,
    reason = "the standard library cannot ask for large pages, and all that a vector holds is its \
              own memory, of which the contents stay"
)]
fn in_large_pages<T>(vector: Vec<T>) -> Vec<T> {
    /// What is smaller has none.
    const LARGE_PAGE: usize = 2 << 20;
    /// Advice begins with a page; where the smallest are larger it may not be taken.
    const SMALL_PAGE: usize = 4 << 10;
    /// Hosts of virtual machines may take back large pages that are free, and giving them anew can
    /// take longer than is won: with hundreds of MiB it did, on and off, by half of all time.
    const MOST: usize = 64 << 20;
    let bytes = vector.capacity() * size_of::<T>();
    if (LARGE_PAGE..=MOST).contains(&bytes) {
        let before = vector.as_ptr() as usize % SMALL_PAGE;
        let start = vector.as_ptr().cast::<u8>().wrapping_sub(before);
        // SAFETY: this advice changes neither what the pages hold nor whether they can be used. So it
        // may reach over all of the first and the last page, which are not the vector's alone.
        let taken = unsafe { libc::madvise(start as *mut _, bytes + before, libc::MADV_HUGEPAGE) };
        // without them it is slower, and nothing else
        let _ = taken;
    }
    vector
}

#[cfg(not(target_os = "linux"))]
fn in_large_pages<T>(vector: Vec<T>) -> Vec<T> {
    vector
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_are_as_they_were_asked_for() {
        for count in [0, 1, 1000, (2 << 20) / 8, 3_000_000] {
            let zeros = zeros::<f64>(count);
            assert!(zeros.len() == count && zeros.iter().all(|&value| value == 0.0));
            let room = with_room::<u64>(count);
            assert!(room.is_empty() && room.capacity() >= count);
            assert!(collected(0..count).into_iter().eq(0..count));
        }
    }

    /// What the system notes of the memory at an address, if it does: two letters each.
    #[cfg(target_os = "linux")]
    fn flags_of_memory(address: usize) -> Option<String> {
        let map = std::fs::read_to_string("/proc/self/smaps").ok()?;
        let holds = |line: &&str| {
            let ends = line.split_once(' ').and_then(|(range, _)| range.split_once('-'));
            let ends = ends.map(|(one, two)| [one, two].map(|n| usize::from_str_radix(n, 16)));
            matches!(ends, Some([Ok(start), Ok(end)]) if (start..end).contains(&address))
        };
        let mut lines = map.lines().skip_while(|line| !holds(line));
        lines.find_map(|line| line.strip_prefix("VmFlags: ")).map(str::to_owned)
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn large_pages_are_asked_for_large_vectors() {
        let has_any = std::path::Path::new("/sys/kernel/mm/transparent_hugepage").exists();
        let vector = zeros::<u64>(4 << 20);
        let middle = vector.as_ptr() as usize + (16 << 20);
        match flags_of_memory(middle) {
            Some(flags) if has_any => assert!(flags.split(' ').any(|flag| flag == "hg"), "{flags}"),
            _ => eprintln!("not looked at: this system has no large pages, or does not tell"),
        }
    }
}
