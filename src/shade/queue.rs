//! The waves that are still to be traced.

use super::wave::{Leaving, Wave};
use crate::math::{BATCH, LaneMask, Lanes};
use crate::scene::Plan;
use crate::trace::Everything;

/// How a ray left the surface before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Mirrored.
    Reflection,
    /// Through it.
    Refraction,
}

/// Waves by depth and kind.
///
/// The deepest that is full goes first; when none is full, the shallowest. So every depth holds at most a few waves,
/// however many rays there will be, and they are as full as can be. The order depends on numbers of rays alone, and is
/// the same for all widths.
#[derive(Debug, Default)]
pub struct Queue {
    /// From depth 2 on.
    levels: Vec<[Line; 2]>,
    free: Vec<Box<Wave>>,
    waiting: usize,
}

/// A copy starts out empty, as the contents matter only while a tile is traced.
impl Clone for Queue {
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// Apart, as a wave lies on the stack while it is made.
#[cold]
#[inline(never)]
fn wave() -> Box<Wave> {
    Box::default()
}

/// Waves of one depth and kind; all but the last are full.
type Line = std::collections::VecDeque<Box<Wave>>;

impl Queue {
    /// Takes the next wave, with its depth and kind.
    #[inline(always)]
    pub fn take(&mut self) -> Option<(Box<Wave>, u32, Kind)> {
        if self.waiting == 0 {
            return None;
        }
        let full = |line: &Line| line.front().is_some_and(|wave| wave.rays.len == BATCH);
        let deepest = self.levels.iter().rposition(|lines| lines.iter().any(full));
        let level = deepest.or_else(|| self.levels.iter().position(|lines| lines.iter().any(|l| !l.is_empty())))?;
        let [reflected, refracted] = &mut self.levels[level];
        let first = if deepest.is_some() { full(reflected) } else { !reflected.is_empty() };
        let (line, kind) = if first { (reflected, Kind::Reflection) } else { (refracted, Kind::Refraction) };
        let wave = line.pop_front()?;
        self.waiting -= 1;
        Some((wave, level as u32 + 2, kind))
    }

    /// A wave without rays.
    #[inline(always)]
    pub fn spare(&mut self) -> Box<Wave> {
        let mut wave = self.free.pop().unwrap_or_else(wave);
        wave.rays.clear();
        wave
    }

    /// Takes a wave back that is done.
    #[inline(always)]
    pub fn give_back(&mut self, wave: Box<Wave>) {
        self.free.push(wave);
    }

    /// Adds a whole wave of mirrored rays to those of `depth`, which is 2 or more.
    #[inline(always)]
    pub fn put(&mut self, depth: u32, wave: Box<Wave>) {
        if wave.rays.len == 0 {
            return self.give_back(wave);
        }
        self.line(depth, Kind::Reflection).push_back(wave);
        self.waiting += 1;
    }

    #[inline(always)]
    fn line(&mut self, depth: u32, kind: Kind) -> &mut Line {
        let level = depth as usize - 2;
        if self.levels.len() <= level {
            self.levels.resize_with(level + 1, Default::default);
        }
        &mut self.levels[level][kind as usize]
    }

    /// Adds the lanes of a packet where `mask` is true to the waves of `depth`, which is 2 or more.
    #[inline(always)]
    pub fn append<L: Lanes>(&mut self, plan: &Plan, depth: u32, kind: Kind, leaving: &Leaving<L>, mask: L::Mask) {
        let mut left = mask.bits();
        while left != 0 {
            if self.line(depth, kind).back().is_none_or(|wave| wave.rays.len == BATCH) {
                let wave = self.spare();
                self.line(depth, kind).push_back(wave);
                self.waiting += 1;
            }
            let Some(wave) = self.line(depth, kind).back_mut() else { return };
            left = wave.append::<L, Everything>(plan, leaving, L::Mask::from_bits(left));
        }
    }
}
