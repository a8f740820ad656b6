//! The batch that a stream comes to next, brought near while the one before it is on its way.

use crate::math::{HitBatch, RayBatch};

/// The parts of the next batch, and of the place for its hits, that are not in the caches yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prefetch<'a> {
    rays: Option<&'a RayBatch>,
    hits: Option<&'a HitBatch>,
    line: usize,
}

impl<'a> Prefetch<'a> {
    /// Nothing comes next, or it is near already.
    pub const NOTHING: Self = Self { rays: None, hits: None, line: RayBatch::LINES + HitBatch::LINES };

    /// The batch after `now` and its hits, where there are any. Whether it has origins to read is taken to be as now: to
    /// look would be to wait for it.
    pub fn after(now: &RayBatch, rays: Option<&'a RayBatch>, hits: Option<&'a HitBatch>) -> Self {
        Self { rays, hits, line: rays.map_or(Self::NOTHING.line, |_| now.first_line()) }
    }

    /// Brings a few more lines near. All at once would be as slow as to wait for them: a core waits for only some two
    /// dozen at a time.
    #[inline(always)]
    pub fn step(&mut self, lines: usize) {
        if self.line >= Self::NOTHING.line {
            return;
        }
        if self.line >= RayBatch::LINES {
            if let Some(hits) = self.hits {
                for line in self.line..self.line + lines {
                    hits.fetch(line - RayBatch::LINES);
                }
            }
        } else if let Some(rays) = self.rays {
            for line in self.line..self.line + lines {
                rays.fetch(line);
            }
        }
        self.line += lines;
    }
}
