//! Cache lines brought near.

use prefetch_index::prefetch_index;

/// All cache lines of what is so large and begins with these numbers.
#[inline(always)]
pub(super) fn lines<T>(bytes: usize, first: Option<&[T]>) {
    let numbers = LINE / size_of::<T>();
    if let Some(first) = first {
        (0..bytes.div_ceil(LINE).min(MAX_LINES)).for_each(|line| prefetch_index(first, numbers * line));
    }
}

/// As many lines are asked for at once; the processor fetches what follows by itself.
const MAX_LINES: usize = 5;

/// Bytes of a cache line.
const LINE: usize = 64;
