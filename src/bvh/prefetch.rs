//! Cache lines brought near.

use prefetch_index::prefetch_index;

/// All cache lines of what is so large and begins with these numbers.
#[inline(always)]
pub(super) fn lines<T>(bytes: usize, first: Option<&[T]>) {
    let numbers = LINE / size_of::<T>();
    if let Some(first) = first {
        (0..bytes.div_ceil(LINE)).for_each(|line| prefetch_index(first, numbers * line));
    }
}

/// Bytes of a cache line.
const LINE: usize = 64;
