//! The batch that a stream comes to next, brought near while the one before it is on its way.

use crate::math::RayBatch;

/// What of the next batch is still far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ahead<'a> {
    next: Option<&'a RayBatch>,
    line: usize,
}

impl<'a> Ahead<'a> {
    /// Of a batch, or of none.
    pub fn of(next: Option<&'a RayBatch>) -> Self {
        Self { next, line: next.map_or(RayBatch::LINES, RayBatch::first_line) }
    }

    /// Brings a few more lines near. All at once would be as slow as to wait for them: a core waits for only some two
    /// dozen at a time.
    #[inline(always)]
    pub fn step(&mut self, lines: usize) {
        if self.line < RayBatch::LINES {
            self.fetch(lines);
        }
    }

    #[inline(always)]
    fn fetch(&mut self, lines: usize) {
        let end = RayBatch::LINES.min(self.line + lines);
        if let Some(next) = self.next {
            (self.line..end).for_each(|line| next.fetch(line));
        }
        self.line = end;
    }
}
