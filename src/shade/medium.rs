//! Which transparent media a ray is in.

use glam::Vec3;

use super::surface::surface;
use crate::scene::Scene;
use crate::trace::Probe;

/// The media around a ray, the one it entered last first: up to four, by their numbers in [`Scene::media`]. Of more
/// the outermost is forgotten.
///
/// Bodies may overlap: leaving one that is not the last leaves the last in place, so that where two media touch and
/// share some space, a ray passes from the one straight into the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MediumStack(u64);

/// The bits of a medium's number.
const BITS: u32 = 16;

impl MediumStack {
    /// The medium that the ray is in, as far as it matters: the one it entered last; 0 for none.
    #[inline(always)]
    pub fn medium(self) -> u16 {
        self.0 as u16
    }

    /// After entering `medium`.
    #[inline(always)]
    pub fn enter(self, medium: u16) -> Self {
        Self(self.0 << BITS | u64::from(medium))
    }

    /// After leaving `medium`, and whether the ray was in it.
    #[inline(always)]
    pub fn leave(self, medium: u16) -> (Self, bool) {
        for shift in (0..u64::BITS).step_by(BITS as usize) {
            if (self.0 >> shift) as u16 == medium {
                let below = self.0 & ((1 << shift) - 1);
                let above = (self.0 >> shift >> BITS) << shift;
                return (Self(above | below), true);
            }
        }
        (self, false)
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
    pub fn new(scene: &Scene, inside: MediumStack, medium: u16, front: bool) -> Self {
        let ior = |medium: u16| scene.media[usize::from(medium)].ior;
        if medium == 0 {
            Self { from: inside.medium(), inside, eta: 1.0 }
        } else if front {
            Self { from: inside.medium(), inside: inside.enter(medium), eta: ior(inside.medium()) / ior(medium) }
        } else {
            let (after, was_inside) = inside.leave(medium);
            // Who leaves what was never entered must have been in it from the start.
            let from = if was_inside { inside.medium() } else { medium };
            Self { from, inside: after, eta: ior(from) / ior(after.medium()) }
        }
    }
}

/// The most surfaces that are looked through to find the media around a point.
const MAX_SURFACES: usize = 1000;

/// The media around a point: those that a ray from there leaves without having entered them.
pub fn around(scene: &Scene, point: Vec3, probe: &mut Probe) -> MediumStack {
    // Along no axis, diagonal or symmetry that scenes are likely to have.
    let direction = Vec3::new(0.267_261_24, 0.801_783_7, 0.534_522_5);
    let mut entered = Vec::new();
    let mut left = Vec::new();
    let mut t = 0.0;
    for _ in 0..MAX_SURFACES {
        let Some(hit) = probe.beyond(scene, point, direction, t) else { break };
        t = hit.t;
        let (surface, material) = surface::<f32>(scene, hit.primitive, (point + direction * t).into());
        let medium = scene.medium_of[material as usize];
        if medium == 0 {
            continue;
        }
        if Vec3::from(surface.normal).dot(direction) <= 0.0 {
            entered.push(medium);
        } else {
            match entered.iter().rposition(|&b| b == medium) {
                Some(at) => drop(entered.remove(at)),
                None => left.push(medium),
            }
        }
    }
    // The innermost is left first.
    left.into_iter().rev().fold(MediumStack::default(), MediumStack::enter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_nest_overlap_and_are_forgotten_from_outside() {
        let nothing = MediumStack::default();
        assert_eq!((nothing.medium(), nothing.leave(3)), (0, (nothing, false)));
        let [glass, water] = [1, 2];
        let nested = nothing.enter(water).enter(glass);
        assert_eq!(nested.medium(), glass);
        assert_eq!(nested.leave(glass), (nothing.enter(water), true));
        // Out of the water while in the glass, as where they overlap.
        assert_eq!(nested.leave(water), (nothing.enter(glass), true));
        assert_eq!(nested.leave(7), (nested, false));
        let twice = nested.enter(water);
        assert_eq!(twice.leave(water), (nested, true));
        let deep = (1..=6).fold(nothing, MediumStack::enter);
        assert_eq!((deep.medium(), deep.leave(2).1, deep.leave(3).1), (6, false, true));
        let out = (3..=6).rev().fold(deep, |inside, medium| inside.leave(medium).0);
        assert_eq!(out, nothing);
    }
}
