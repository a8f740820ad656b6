//! The slightly different questions that an `f32` answer may be the exact answer to.
use crate::reference::Rounding;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// How many unit roundoffs of `f32` a ray may be off; see [the bound](super#the-error-bound).
///
/// The longest chain of roundings from pixel to hit (screen point, normalisation, distance from the centre or the
/// edges, root) has about a dozen, each of at most one u.
pub const K: f64 = 16.0;

/// Half the distance from 1 to the next `f32`.
pub(super) const U: f64 = 1.0 / (1u64 << 24) as f64;

/// How many questions are asked, round by round, before an answer counts as unexplained.
///
/// Most edges show in the first round; the last is for chaotic pixels, where every mirror multiplies the error and the
/// range of answers fills slowly.
pub const ROUNDS: [u32; 3] = [48, 192, 768];

/// A ray and how far it may be off.
pub(super) struct Neighbourhood {
    pub origin: DVec3,
    pub direction: DVec3,
    /// The s of the bound.
    pub scale: f64,
    /// The k of the bound; more than [`K`] where the direction is not of unit length.
    pub k: f64,
}

/// One question: a ray, and how roughly its secondary rays are followed.
pub(super) struct Question {
    pub origin: DVec3,
    pub direction: DVec3,
    pub rounding: Rounding,
}

impl Neighbourhood {
    /// The `i`th question; always the same for the same neighbourhood.
    ///
    /// A third turn the direction, a third move the origin, a third do both. Secondary rays are shifted like the origin;
    /// in every other triple they are lifted more than finely, more often little than much.
    pub fn question(&self, i: u32) -> Question {
        let turn = if i % 3 == 1 { DVec3::ZERO } else { self.turn(i) };
        let ku = self.k * U;
        let shift = if i.is_multiple_of(3) { DVec3::ZERO } else { ku * self.shift(i) };
        let lift = if (i / 3).is_multiple_of(2) { 0.0 } else { ku * spread(i, 11.0).powi(2) };
        Question {
            origin: self.origin + self.scale * shift,
            direction: (self.direction + ku * turn).normalize(),
            rounding: Rounding { lift: lift.max(Rounding::FINE.lift), shift },
        }
    }

    /// Within the unit disc across the direction.
    fn turn(&self, i: u32) -> DVec3 {
        let (a, b) = self.direction.any_orthonormal_pair();
        let (sin, cos) = (TAU * spread(i, 2.0)).sin_cos();
        (a * cos + b * sin) * spread(i, 3.0).sqrt()
    }

    /// Within the unit ball; every other one near its middle, at all scales down to 1e-6, since where two surfaces
    /// meet at a flat angle only a small shift lies between the one and the other.
    fn shift(&self, i: u32) -> DVec3 {
        let z = 2.0 * spread(i, 5.0) - 1.0;
        let (sin, cos) = (TAU * spread(i, 7.0)).sin_cos();
        let across = (1.0 - z * z).sqrt();
        let far = spread(i, PI).cbrt();
        let radius = if (i / 6).is_multiple_of(2) { far } else { 1e-6_f64.powf(spread(i, PI)) };
        DVec3::new(across * cos, across * sin, z) * radius
    }
}

/// Spreads indices evenly over 0..1: the fractional part of (i + 1) times an irrational, the root of `seed`.
fn spread(i: u32, seed: f64) -> f64 {
    (f64::from(i + 1) * seed.sqrt()).fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn questions_stay_within_the_bound_and_reach_all_around() {
        let around = Neighbourhood { origin: DVec3::new(1.0, 2.0, 3.0), direction: DVec3::X, scale: 10.0, k: K };
        let mut corner = [(DVec3::ZERO, DVec3::ZERO); 2];
        for i in 0..ROUNDS[0] {
            let question = around.question(i);
            let turn = (question.direction - around.direction) / (K * U);
            let shift = (question.origin - around.origin) / (K * U * around.scale);
            assert!(turn.length() < 1.000_01 && shift.length() < 1.000_01, "{i}: {turn} {shift}");
            corner[0] = (corner[0].0.min(turn), corner[0].1.min(shift));
            corner[1] = (corner[1].0.max(turn), corner[1].1.max(shift));
        }
        for (turn, shift) in corner {
            assert!(turn.y.abs() > 0.7 && turn.z.abs() > 0.7 && shift.abs().min_element() > 0.6, "{turn} {shift}");
        }
    }
}
