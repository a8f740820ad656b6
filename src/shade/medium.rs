//! Which transparent media a ray is in.

use std::collections::HashMap;

use crate::scene::Scene;

/// The media around a ray, the one it entered last first, by their numbers in [`Scene::media`]: up to four of 16 bits
/// each. Of more, the last stands here, and the others' number in [`Deeper`].
///
/// Bodies may overlap: leaving one that is not the last leaves the last in place, so that where two media touch and
/// share some space, a ray passes from the one straight into the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct MediumStack(u64);

/// The bits of a medium's number.
const BITS: u32 = 16;
/// In the second place: the others are in [`Deeper`], at the number in the upper half. No medium has this number.
const DEEPER: u64 = u16::MAX as u64;

/// Stacks that others stand on, where more than four media lie in each other. Equal stacks have one number.
#[derive(Clone, Debug, Default)]
pub struct Deeper {
    stacks: Vec<MediumStack>,
    number: HashMap<MediumStack, u32>,
}

impl Deeper {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.stacks.len()
    }

    #[cold]
    #[inline(never)]
    fn with(&mut self, medium: u16, on: MediumStack) -> MediumStack {
        let next = self.stacks.len() as u32;
        let number = *self.number.entry(on).or_insert(next);
        if number == next {
            self.stacks.push(on);
        }
        MediumStack(u64::from(number) << (2 * BITS) | DEEPER << BITS | u64::from(medium))
    }

    /// What remains when `medium` is taken out, if it is there.
    #[cold]
    #[inline(never)]
    fn without(&mut self, stack: MediumStack, medium: u16) -> Option<MediumStack> {
        let mut above = Vec::new();
        let mut rest = stack;
        loop {
            let (last, below) = rest.split(self);
            rest = below;
            if last == medium {
                break;
            }
            if rest == MediumStack::default() {
                return None;
            }
            above.push(last);
        }
        Some(above.into_iter().rev().fold(rest, |stack, medium| stack.enter(medium, self)))
    }
}

impl MediumStack {
    /// The medium that the ray is in, as far as it matters: the one it entered last; 0 for none.
    #[inline(always)]
    pub fn medium(self) -> u16 {
        self.0 as u16
    }

    /// After entering `medium`.
    #[inline(always)]
    pub fn enter(self, medium: u16, deeper: &mut Deeper) -> Self {
        if self.0 >> (3 * BITS) != 0 || self.is_deep() {
            return deeper.with(medium, self);
        }
        Self(self.0 << BITS | u64::from(medium))
    }

    /// After leaving `medium`; `None` where the ray was not in it.
    #[inline(always)]
    pub fn leave(self, medium: u16, deeper: &mut Deeper) -> Option<Self> {
        if self.is_deep() {
            return deeper.without(self, medium);
        }
        for shift in (0..u64::BITS).step_by(BITS as usize) {
            if (self.0 >> shift) as u16 == medium {
                let below = self.0 & ((1 << shift) - 1);
                let above = (self.0 >> shift >> BITS) << shift;
                return Some(Self(above | below));
            }
        }
        None
    }

    #[inline(always)]
    fn is_deep(self) -> bool {
        self.0 >> BITS & DEEPER == DEEPER
    }

    /// The medium entered last, and the others.
    fn split(self, deeper: &Deeper) -> (u16, Self) {
        let below = match self.is_deep() {
            true => deeper.stacks[(self.0 >> (2 * BITS)) as usize],
            false => Self(self.0 >> BITS),
        };
        (self.medium(), below)
    }
}

/// The media on the two sides of a surface that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// The medium that the ray came through; 0 for none.
    pub from: u16,
    /// The media around the ray that goes on through the surface.
    pub inside: MediumStack,
    /// Index of refraction before the surface, divided by the one behind it.
    pub eta: f32,
}

impl Passage {
    /// For a ray that was `inside` and meets a surface of `medium` (0 for one that is not transparent) from its front or
    /// back.
    #[inline(always)]
    pub fn new(scene: &Scene, inside: MediumStack, medium: u16, front: bool, deeper: &mut Deeper) -> Self {
        let ior = |medium: u16| scene.media[usize::from(medium)].ior;
        if medium == 0 {
            Self { from: inside.medium(), inside, eta: 1.0 }
        } else if front {
            let after = inside.enter(medium, deeper);
            Self { from: inside.medium(), inside: after, eta: ior(inside.medium()) / ior(medium) }
        } else {
            let (from, after) = match inside.leave(medium, deeper) {
                Some(after) => (inside.medium(), after),
                // Who leaves what was never entered must have been in it from the start.
                None => (medium, inside),
            };
            Self { from, inside: after, eta: ior(from) / ior(after.medium()) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_nest_and_overlap() {
        let (nothing, mut deeper) = (MediumStack::default(), Deeper::default());
        assert_eq!((nothing.medium(), nothing.leave(3, &mut deeper)), (0, None));
        let [glass, water] = [1, 2];
        let nested = nothing.enter(water, &mut deeper).enter(glass, &mut deeper);
        assert_eq!(nested.medium(), glass);
        assert_eq!(nested.leave(glass, &mut deeper), Some(nothing.enter(water, &mut deeper)));
        // Out of the water while in the glass, as where they overlap.
        assert_eq!(nested.leave(water, &mut deeper), Some(nothing.enter(glass, &mut deeper)));
        assert_eq!(nested.leave(7, &mut deeper), None);
        let twice = nested.enter(water, &mut deeper);
        assert_eq!(twice.leave(water, &mut deeper), Some(nested));
        assert_eq!(deeper.len(), 0);
    }

    /// However many there are, and in whatever order they are left, a stack is as a list would be, and equal lists are equal
    /// stacks.
    #[test]
    fn stacks_of_any_depth_are_as_lists() {
        let mut deeper = Deeper::default();
        let mut state = 1u64;
        let mut random = |n: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) % n
        };
        let mut seen: HashMap<Vec<u16>, MediumStack> = HashMap::new();
        for _ in 0..200 {
            let (mut list, mut stack) = (Vec::new(), MediumStack::default());
            for _ in 0..60 {
                let medium = 1 + random(3) as u16;
                if random(5) < 3 {
                    list.push(medium);
                    stack = stack.enter(medium, &mut deeper);
                } else {
                    let at = list.iter().rposition(|&m| m == medium);
                    at.map(|at| list.remove(at));
                    let after = stack.leave(medium, &mut deeper);
                    assert_eq!(after.is_some(), at.is_some());
                    stack = after.unwrap_or(stack);
                }
                assert_eq!(stack.medium(), list.last().copied().unwrap_or(0));
                assert_eq!(*seen.entry(list.clone()).or_insert(stack), stack, "{list:?}");
            }
        }
        assert!(deeper.len() > 100 && seen.keys().any(|list| list.len() > 12));
    }
}
